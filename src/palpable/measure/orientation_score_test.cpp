// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/orientation_score.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

Directions all_at(double degrees, float strength = 1.0F) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {Raster<float>(20, 16, static_cast<float>(std::cos(a))),
          Raster<float>(20, 16, static_cast<float>(std::sin(a))), Raster<float>(20, 16, strength)};
}

TEST(OrientationScore, IsTheAngleBetweenTheDirections) {
  const auto score = score_orientation(all_at(33.0), all_at(30.0), {});
  ASSERT_TRUE(score);
  EXPECT_EQ(score->pixels, 320U);
  EXPECT_NEAR(score->max_deg, 3.0, 1e-4);
  EXPECT_NEAR(score->mean_deg, 3.0, 1e-4);
  EXPECT_NEAR(score->rms_deg, 3.0, 1e-4);
}

TEST(OrientationScore, TreatsOppositeDirectionsAsEqual) {
  EXPECT_NEAR(score_orientation(all_at(30.0), all_at(210.0), {})->max_deg, 0.0, 1e-4);
  EXPECT_NEAR(score_orientation(all_at(1.0), all_at(179.0), {})->max_deg, 2.0, 1e-4);
}

TEST(OrientationScore, CountsStrongPixelsInsideTheMarginOnly) {
  Directions result = all_at(0.0);
  result.strength(3, 3) = 0.5F;
  result.tangent_x(3, 3) = 0.0F;
  result.tangent_y(3, 3) = 1.0F;
  EXPECT_NEAR(score_orientation(result, all_at(0.0), {})->max_deg, 0.0, 1e-4);
  EXPECT_NEAR(score_orientation(result, all_at(0.0), {0.2, 0})->max_deg, 90.0, 1e-4);
  EXPECT_EQ(score_orientation(result, all_at(0.0), {0.8, 7})->pixels, 6U * 2U);
}

TEST(OrientationScore, IgnoresPixelsWhereTheTruthHasNoDirection) {
  Directions truth = all_at(0.0);
  for (int x = 0; x < 20; ++x) truth.tangent_x(x, 5) = 0.0F;
  EXPECT_EQ(score_orientation(all_at(0.0), truth, {})->pixels, 300U);
  truth.strength(0, 0) = 0.0F;
  EXPECT_EQ(score_orientation(all_at(0.0), truth, {})->pixels, 299U);
}

TEST(OrientationScore, RefusesSizesThatDifferAndNothingToCompare) {
  EXPECT_FALSE(score_orientation(all_at(0.0), {Raster<float>(4, 4), Raster<float>(4, 4), {}}, {}));
  EXPECT_FALSE(score_orientation(all_at(0.0), all_at(0.0), {0.8, 10}));
  EXPECT_FALSE(score_orientation(all_at(0.0, 0.0F), all_at(0.0), {}));
}

}  // namespace
}  // namespace palpable::measure
