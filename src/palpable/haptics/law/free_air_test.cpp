// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Fast hands over cliffs, walls and hills of coarse and fine pixels, and round solids: no force in free air,
// and a first contact in the tick in which it happens. The truth is taken from the surface itself, densely.
#include "palpable/haptics/law/field_proxy.hpp"
#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kStiffness = 500.0;
constexpr double kT_s = 0.001;

/// Plateaus, walls and hills over 60 x 40 mm.
models::Scene rough_scene(double pixel_m, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Raster<float> z(static_cast<int>(0.06 / pixel_m), static_cast<int>(0.04 / pixel_m));
  for (int k = 0; k < 30; ++k) {
    const double x = unit(random) * z.width();
    const double y = unit(random) * z.height();
    const double half = (0.0005 + 0.006 * unit(random)) / pixel_m;
    const float height = static_cast<float>(0.008 * unit(random));
    const bool is_hill = k % 2 == 0;
    for (int j = 0; j < z.height(); ++j)
      for (int i = 0; i < z.width(); ++i) {
        const double d = std::hypot(i - x, j - y) / half;
        if (is_hill) z(i, j) += height * static_cast<float>(std::exp(-d * d));
        if (!is_hill && d < 1.0) z(i, j) = std::max(z(i, j), height);
      }
  }
  return scene_of(std::move(z), pixel_m);
}

struct Stroke {
  Vec3 from;
  Vec3 to;
  double speed_m_per_s;
};

struct Findings {
  int clear_ticks = 0;
  int first_contacts = 0;
  int pushed_in_air = 0;
  int late = 0;
  double greatest_first_N = 0.0;
};

/// `height_over(p)` > 0 outside. A stroke ends with its first contact.
template <class HeightOver>
void follow(const Touchable& touchable, const Stroke& stroke, HeightOver height_over, Findings& findings) {
  constexpr int kBetween = 200;
  // What the truth's own sampling cannot decide.
  constexpr double kMargin_m = 3e-6;
  const double length = norm(stroke.to - stroke.from);
  const int ticks = std::max(2, static_cast<int>(length / (stroke.speed_m_per_s * kT_s)));
  TouchState state;
  Hand hand;
  Vec3 last = stroke.from;
  for (int n = 0; n <= ticks; ++n) {
    const Vec3 p = stroke.from + (static_cast<double>(n) / ticks) * (stroke.to - stroke.from);
    double least = height_over(p);
    for (int k = 1; n > 0 && k < kBetween; ++k)
      least = std::min(least, height_over(last + (static_cast<double>(k) / kBetween) * (p - last)));
    hand.position = {p};
    hand.velocity_m_per_s = {(n > 0 ? 1.0 : 0.0) / kT_s * (p - last)};
    const LawOutput output = touchable.evaluate(hand, state);
    const double force_N = norm(output.force_N);
    if (n == 0 && least <= kMargin_m) return;
    if (least > kMargin_m) {
      ++findings.clear_ticks;
      findings.pushed_in_air += force_N > 0.0 || output.contact ? 1 : 0;
    } else {
      if (height_over(p) < -kMargin_m) {
        ++findings.first_contacts;
        findings.late += output.contact && force_N > 0.0 ? 0 : 1;
        // Never more than the way under the surface.
        findings.greatest_first_N = std::max(findings.greatest_first_N, force_N / (norm(p - last) + 1e-6));
      }
      return;
    }
    last = p;
  }
}

Stroke random_stroke(std::mt19937& random, double fastest_m_per_s) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Vec3 from{0.026 * unit(random), 0.016 * unit(random), 0.0105};
  // Down to somewhere, then, mostly, along: grazing strokes are the hard ones.
  const Vec3 to{0.026 * unit(random), 0.016 * unit(random), 0.004 + 0.004 * unit(random)};
  return {from, to, fastest_m_per_s * std::exp(-1.5 * std::abs(unit(random)))};
}

TEST(FreeAir, HasNoForceAndEndsInTheTickOfTheFirstContactOnReliefsOfEveryResolution) {
  std::mt19937 random(5);
  Findings findings;
  for (const double pixel_m : {0.0001, 0.00025, 0.0007, 0.002})
    for (int ground = 0; ground < 2; ++ground) {
      const models::Scene scene = rough_scene(pixel_m, random);
      const auto& relief = *models::relief_of(scene);
      LawParameters p = frictionless();
      p.stiffness_N_per_m = kStiffness;
      p.static_friction = ground == 0 ? 0.0 : 0.5;
      const auto law = made(scene, p);
      for (int k = 0; k < 250; ++k)
        follow(
            *law, random_stroke(random, 2.0), [&](Vec3 at) { return at.z - relief.sample(at.x, at.y).z_m; },
            findings);
    }
  EXPECT_EQ(findings.pushed_in_air, 0) << "of " << findings.clear_ticks;
  EXPECT_EQ(findings.late, 0) << "of " << findings.first_contacts;
  EXPECT_LE(findings.greatest_first_N, 1.01 * kStiffness);
  EXPECT_GT(findings.clear_ticks, 20000);
  EXPECT_GT(findings.first_contacts, 500);
}

/// Balls of 3 mm on a plate, their union.
class Pebbles {
 public:
  models::FieldSample sample(Vec3 p) const noexcept {
    const Vec3 middle{0.008 * std::round(p.x / 0.008), 0.008 * std::round(p.y / 0.008), 0.002};
    const Vec3 away = p - middle;
    const double ball = norm(away) - 0.003;
    return ball < p.z ? models::FieldSample{ball, unit(away)} : models::FieldSample{p.z, {0.0, 0.0, 1.0}};
  }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

class PebbleTouchable final : public Touchable {
 public:
  explicit PebbleTouchable(double friction)
      : law_(std::make_shared<const Pebbles>(), MaterialMap({kStiffness, 0.0, friction, friction}), 0.0) {}
  LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept override {
    return law_.evaluate(hand, state_as<FieldProxyLaw<Pebbles>::State>(state));
  }
  std::uint64_t state_family() const noexcept override { return 1; }
  double damping_Ns_per_m() const noexcept override { return 0.0; }
  void touch_pages() const noexcept override {}

 private:
  FieldProxyLaw<Pebbles> law_;
};

TEST(FreeAir, HasNoForceAndEndsInTheTickOfTheFirstContactRoundSolids) {
  std::mt19937 random(6);
  Findings findings;
  const Pebbles pebbles;
  for (const double friction : {0.0, 0.5}) {
    const PebbleTouchable touchable(friction);
    for (int k = 0; k < 800; ++k) {
      Stroke stroke = random_stroke(random, 2.0);
      stroke.to.z -= 0.002;
      follow(
          touchable, stroke, [&](Vec3 at) { return pebbles.sample(at).distance_m; }, findings);
    }
  }
  EXPECT_EQ(findings.pushed_in_air, 0) << "of " << findings.clear_ticks;
  EXPECT_EQ(findings.late, 0) << "of " << findings.first_contacts;
  EXPECT_LE(findings.greatest_first_N, 1.01 * kStiffness);
  EXPECT_GT(findings.clear_ticks, 20000);
  EXPECT_GT(findings.first_contacts, 500);
}

TEST(FreeAir, ComesAtOnceToAHandThatLeavesASlopeFast) {
  Raster<float> slope(400, 100);
  for (int j = 0; j < slope.height(); ++j)
    for (int i = 0; i < slope.width(); ++i) slope(i, j) = static_cast<float>(0.3 * i * 0.0001);
  const models::Scene scene = scene_of(std::move(slope), 0.0001);
  const auto& relief = *models::relief_of(scene);
  const auto law = made(scene, frictionless());
  TouchState state;
  const auto above = [&](double x, double height) {
    return Vec3{x, 0.0, relief.sample(x, 0.0).z_m + height};
  };
  output_at(*law, state, above(-0.015, 0.001));
  // Along the slope at 2 m/s, 0.1 mm under it: without friction the push is straight out, with no lag.
  const Vec3 normal = unit(Vec3{-0.3, 0.0, 1.0});
  for (double x = -0.015; x < 0.0; x += 0.002) {
    const LawOutput output = output_at(*law, state, above(x, -0.0001));
    ASSERT_TRUE(output.contact);
    EXPECT_NEAR(norm(cross(output.force_N.v, normal)), 0.0, 1e-4) << x;
  }
  const LawOutput left = output_at(*law, state, above(0.002, 0.0001));
  EXPECT_FALSE(left.contact);
  EXPECT_EQ(left.force_N.v, Vec3{});
}

}  // namespace
}  // namespace palpable::haptics
