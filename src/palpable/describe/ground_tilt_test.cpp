// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/ground_tilt.hpp"

#include "palpable/describe/test_scenes.hpp"

#include <random>

namespace palpable::describe {
namespace {

constexpr double kCell_m = 0.001;

template <class Height>
Raster<float> grid(const Height& height) {
  Raster<float> z(100, 80);
  for (int j = 0; j < 80; ++j)
    for (int i = 0; i < 100; ++i)
      z(i, j) = static_cast<float>(height((i - 49.5) * kCell_m, (39.5 - j) * kCell_m));
  return z;
}

TEST(GroundTilt, IsFoundUnderObjectsAndNoise) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.00005);
  const auto plane = ground_plane_of(grid([&](double x, double y) {
                                       return 0.004 + 0.05 * x - 0.02 * y + bump(x, y, 0.02, 0.01, 0.01) +
                                              bump(x, y, -0.02, -0.01, 0.006) + noise(random);
                                     }),
                                     kCell_m, kCell_m);
  ASSERT_TRUE(plane);
  EXPECT_NEAR(plane->dzdx, 0.05, 0.002);
  EXPECT_NEAR(plane->dzdy, -0.02, 0.002);
  EXPECT_NEAR(plane->height_m(0.0, 0.0), 0.004, 0.0001);
}

TEST(GroundTilt, IsNoSideOfARoofAndNoHill) {
  EXPECT_FALSE(
      ground_plane_of(grid([](double x, double) { return 0.01 - 0.2 * std::abs(x); }), kCell_m, kCell_m));
  EXPECT_FALSE(ground_plane_of(
      grid([](double x, double y) { return 0.02 * std::exp(-(x * x + y * y) / (0.03 * 0.03)); }), kCell_m,
      kCell_m));
  EXPECT_FALSE(ground_plane_of(Raster<float>(10, 10, 0.003F), kCell_m, kCell_m)) << "level: nothing to tilt";
}

}  // namespace
}  // namespace palpable::describe
