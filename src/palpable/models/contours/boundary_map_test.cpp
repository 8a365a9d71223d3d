// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/contours/boundary_map.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

static_assert(BoundaryField<BoundaryMap>);

BoundaryPixel along(double angle, double strength) {
  return {static_cast<float>(strength * std::cos(2 * angle)),
          static_cast<float>(strength * std::sin(2 * angle))};
}

TEST(BoundaryMap, ReturnsTheTangentOfEveryAngleUpToItsSign) {
  for (int k = 0; k < 36; ++k) {
    const double angle = k * std::numbers::pi / 36.0;
    const auto map =
        BoundaryMap::from_edges(Raster<BoundaryPixel>(4, 4, along(angle, 0.5)), 0.001, 1.0, {}, Work{});
    ASSERT_TRUE(map);
    const BoundarySample s = map->sample(0.0003, -0.0004);
    EXPECT_NEAR(s.strength, 0.5, 1e-6);
    EXPECT_NEAR(std::abs(s.tangent_x * std::cos(angle) + s.tangent_y * std::sin(angle)), 1.0, 1e-6);
  }
}

TEST(BoundaryMap, IsContinuousAcrossPixels) {
  Raster<BoundaryPixel> pixels(8, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) pixels(x, y) = along(0.3 * x + 0.2 * y, 0.4 + 0.05 * x);
  const auto map = BoundaryMap::from_edges(pixels, 0.001, 1.0, {}, Work{});
  ASSERT_TRUE(map);
  BoundarySample before = map->sample(-0.003, 0.001);
  for (double x = -0.003; x < 0.003; x += 1e-6) {
    const BoundarySample now = map->sample(x, 0.001);
    EXPECT_LT(std::abs(now.strength - before.strength), 1e-3);
    EXPECT_GT(std::abs(now.tangent_x * before.tangent_x + now.tangent_y * before.tangent_y), 1.0 - 1e-5);
    before = now;
  }
}

TEST(BoundaryMap, AveragesTheTwoSidesOfAThinLineIntoOne) {
  // Gradients of opposite sign have the same doubled angle: both columns point downwards.
  Raster<BoundaryPixel> edges(9, 9);
  for (int y = 0; y < 9; ++y) edges(3, y) = edges(5, y) = along(std::numbers::pi / 2, 1.0);
  const auto map = BoundaryMap::from_edges(edges, 0.001, 3.0, {}, Work{});
  ASSERT_TRUE(map);
  const BoundarySample between = map->sample(0.0, 0.0);
  EXPECT_GT(between.strength, 0.3);
  EXPECT_NEAR(std::abs(between.tangent_y), 1.0, 1e-6);
}

TEST(BoundaryMap, KeepsAConstantField) {
  const auto map =
      BoundaryMap::from_edges(Raster<BoundaryPixel>(21, 21, along(0.7, 0.6)), 0.001, 5.0, {}, Work{});
  ASSERT_TRUE(map);
  EXPECT_NEAR(map->sample(0.0, 0.0).strength, 0.6, 1e-5);
}

TEST(BoundaryMap, IsZeroOutside) {
  const auto map =
      BoundaryMap::from_edges(Raster<BoundaryPixel>(4, 4, along(1.0, 1.0)), 0.001, 1.0, {}, Work{});
  EXPECT_EQ(map->sample(0.01, 0.0).strength, 0.0);
  EXPECT_EQ(map->sample(0.0, -0.01).strength, 0.0);
}

TEST(BoundaryMap, RefusesInvalidStrengths) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(BoundaryMap::from_edges(Raster<BoundaryPixel>(4, 4, {nan, 0.0F}), 0.001, 1.0, {}, Work{}));
  EXPECT_FALSE(BoundaryMap::from_edges(Raster<BoundaryPixel>(4, 4, {2.0F, 0.0F}), 0.001, 1.0, {}, Work{}));
  EXPECT_FALSE(BoundaryMap::from_edges(Raster<BoundaryPixel>(1, 4), 0.001, 1.0, {}, Work{}));
  EXPECT_FALSE(BoundaryMap::from_edges(Raster<BoundaryPixel>(4, 4), 0.0, 1.0, {}, Work{}));
}

}  // namespace
}  // namespace palpable::models
