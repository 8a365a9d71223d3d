// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/laws.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/models/relief/relief_distance.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kPixel_m = 0.00015625;
constexpr double kStiffness_N_per_m = 500.0;

/// Walls of 1 mm, grooves and spikes, with and without their slopes limited.
models::Scene obstacles(double steepest_slope) {
  Raster<float> z(320, 240, 0.002F);
  for (int i = 20; i < 320; i += 60)
    for (int j = 0; j < 240; ++j)
      for (int k = 0; k < 6; ++k) {
        z(i + k, j) = 0.010F;
        z(i + 30 + k % 3, j) = 0.0F;
      }
  for (int j = 15; j < 240; j += 40)
    for (int i = 40; i < 320; i += 60) z(i, j) = z(i + 1, j) = z(i, j + 1) = z(i + 1, j + 1) = 0.009F;
  if (steepest_slope > 0.0) models::limit_slope(z, kPixel_m, steepest_slope);
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*models::Relief::from_samples(std::move(z), kPixel_m));
  return scene;
}

TEST(ProxyLaw, ClimbsOverAWallInsteadOfJumpingThroughIt) {
  const models::Scene scene = obstacles(3.0);
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(scene.model);
  LawParameters p;
  p.static_friction = 0.0;
  const auto law = *make_touchable(scene, p);
  for (const double speed : {0.1, 0.3, 1.0}) {
    TouchState state;
    Hand hand;
    double highest = 0.0;
    double x = -0.020;
    Vec3 proxy{};
    for (int k = 0; k < 200; ++k) {
      hand.position = {{x, 0.0, 0.012 - 0.00005 * k}};
      proxy = law->evaluate(hand, state).proxy.v;
    }
    while (x < 0.003) {
      x += speed * kT_s;
      hand.position = {{x, 0.0, 0.002}};
      const Vec3 next = law->evaluate(hand, state).proxy.v;
      for (double f = 0.0; f < 1.0; f += 0.1) {
        const double u = proxy.x + f * (next.x - proxy.x);
        highest = std::max(highest, relief.sample(u, proxy.y).z_m - (proxy.z + f * (next.z - proxy.z)));
      }
      proxy = next;
    }
    EXPECT_GT(proxy.x, -0.012) << "it gets across the first wall, which stands at -12.4 mm";
    EXPECT_LT(highest, 0.0009)
        << "and the straight way between two ticks, three steps of a pixel up a slope of "
           "3 and down again, cuts no corner by more than 1.5 of them";
  }
}

}  // namespace
}  // namespace palpable::haptics
