// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A contact after free air is like a first one: nothing of an earlier contact is left in the law or the tick.
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/tick/test_loop.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kAir_m = 0.012;
constexpr double kDeep_m = 0.004;
/// As long as the window of the velocity.
constexpr int kInAir = 16;

/// A stroke from the air through the surface into the air.
void stroke(std::vector<Vec3>& way, Vec3 from, Vec3 to) {
  constexpr int kTicks = 200;
  for (int n = 1; n <= kTicks; ++n) {
    const double share = static_cast<double>(n) / kTicks;
    Vec3 p = from + share * (to - from);
    p.z = kAir_m - (kAir_m - kDeep_m) * std::sin(std::numbers::pi * share);
    way.push_back(p);
  }
}

/// The forces along the second way, after the first.
std::vector<Vec3> forces_on(const std::shared_ptr<const Touchable>& touchable, const std::vector<Vec3>& first,
                            const std::vector<Vec3>& second) {
  Loop loop(touchable);
  std::vector<Vec3> forces;
  for (const auto* way : {&first, &second})
    for (const Vec3 p : *way) {
      loop.device.reading = {{p}, device::Status::ok};
      loop.run(1);
      if (way == &second) forces.push_back(loop.written());
    }
  return forces;
}

class SecondContact : public testing::TestWithParam<double> {};

TEST_P(SecondContact, IsToTheLastBitAsAFirstOneOnNoise) {
  for (unsigned seed = 1; seed <= 24; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> share(-1.0, 1.0);
    Raster<float> z(200, 160, 0.005F);
    for (float& height : z.values()) height += 0.0005F * static_cast<float>(1.0 + share(random));
    models::limit_slope(z, kPixel_m, 3.0);
    LawParameters parameters;
    parameters.law = Law::proxy;
    parameters.stiffness_N_per_m = 500.0;
    parameters.damping_Ns_per_m = 1.0;
    parameters.static_friction = GetParam();
    const auto touchable = made(scene_of(std::move(z)), parameters);
    const auto place = [&] { return Vec3{0.012 * share(random), 0.008 * share(random), kAir_m}; };
    const Vec3 a = place(), b = place(), c = place();
    std::vector<Vec3> first, second(kInAir, b);
    stroke(first, a, b);
    stroke(second, b, c);
    EXPECT_EQ(forces_on(touchable, first, second), forces_on(touchable, {}, second)) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Frictions, SecondContact, testing::Values(0.0, 0.5), [](const auto& friction) {
  return std::to_string(static_cast<int>(100.0 * friction.param)) + "_percent";
});

}  // namespace
}  // namespace palpable::haptics
