// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/measure/relief_score.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::measure {
namespace {

constexpr double kPixel_m = 0.0002;

/// The relief is half as high as the scene.
ReliefScoreOptions half() {
  ReliefScoreOptions options;
  options.compression = 2.0;
  return options;
}

/// Gentle hills with ripples, in metres of a scene in its own proportions.
Raster<float> hills() {
  Raster<float> z(120, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x)
      z(x, y) =
          static_cast<float>(0.005 * std::sin(0.05 * x) * std::cos(0.06 * y) + 0.0006 * std::sin(1.1 * x));
  return z;
}

Raster<float> scaled(Raster<float> z, float factor) {
  for (float& v : z.values()) v *= factor;
  return z;
}

TEST(ScoreRelief, IsPerfectForTheSceneAtHalfItsHeight) {
  const auto score = score_relief(scaled(hills(), 0.5F), kPixel_m, hills(), half());
  ASSERT_TRUE(score);
  EXPECT_EQ(score->reversed_slopes_percent, 0.0);
  EXPECT_NEAR(score->detail_correlation, 1.0, 1e-3);
  EXPECT_GT(score->details, 10U);
  EXPECT_EQ(score->details_kept_percent, 100.0);
  EXPECT_EQ(score->wrong_order_percent, 0.0);
}

TEST(ScoreRelief, FindsAnEngravedSceneReversed) {
  const auto score = score_relief(scaled(hills(), -0.5F), kPixel_m, hills(), half());
  ASSERT_TRUE(score);
  EXPECT_GT(score->reversed_slopes_percent, 80.0);
  EXPECT_LT(score->detail_correlation, -0.9);
  EXPECT_EQ(score->details_kept_percent, 0.0);
}

TEST(ScoreRelief, CountsSmoothedDetailAsLost) {
  Raster<float> smooth(120, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 120; ++x)
      smooth(x, y) = static_cast<float>(0.0025 * std::sin(0.05 * x) * std::cos(0.06 * y));
  ReliefScoreOptions options = half();
  options.felt_m = 0.0001;
  const auto score = score_relief(smooth, kPixel_m, hills(), options);
  ASSERT_TRUE(score);
  EXPECT_LT(score->details_kept_percent, 5.0);
  EXPECT_LT(score->detail_correlation, 0.5);
}

TEST(ScoreRelief, CountsStepsInTheWrongOrder) {
  Raster<float> truth(64, 64);
  Raster<float> right(64, 64);
  Raster<float> wrong(64, 64);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      truth(x, y) = x < 32 ? 0.0F : 1.0F;
      right(x, y) = x < 32 ? 0.0F : 0.001F;
      wrong(x, y) = x < 32 ? 0.001F : 0.0F;
    }
  EXPECT_EQ(score_relief(right, kPixel_m, truth, {})->wrong_order_percent, 0.0);
  EXPECT_EQ(score_relief(wrong, kPixel_m, truth, {})->wrong_order_percent, 100.0);
  EXPECT_EQ(score_relief(right, kPixel_m, truth, {})->depth_steps, 64U * 4U);
  EXPECT_NEAR(score_relief(right, kPixel_m, truth, {})->greatest_slope, 0.001 / (2 * kPixel_m), 1e-3);
}

TEST(ScoreRelief, IgnoresUnknownDepth) {
  Raster<float> truth = hills();
  for (int y = 0; y < 100; ++y)
    for (int x = 60; x < 120; ++x) truth(x, y) = std::numeric_limits<float>::quiet_NaN();
  Raster<float> relief = scaled(hills(), 0.5F);
  for (int y = 0; y < 100; ++y)
    for (int x = 70; x < 120; ++x) relief(x, y) = -relief(x, y);
  const auto score = score_relief(relief, kPixel_m, truth, half());
  ASSERT_TRUE(score);
  EXPECT_EQ(score->reversed_slopes_percent, 0.0);
  EXPECT_GT(score->detail_correlation, 0.99);
}

TEST(ScoreRelief, RefusesMapsThatCannotBeCompared) {
  EXPECT_FALSE(score_relief(Raster<float>(20, 20), kPixel_m, Raster<float>(20, 21), {}));
  EXPECT_FALSE(score_relief(Raster<float>(8, 8), kPixel_m, Raster<float>(8, 8), {}));
  EXPECT_FALSE(score_relief(Raster<float>(20, 20), kPixel_m, Raster<float>(20, 20, 1.0F), {}));
  EXPECT_FALSE(score_relief(Raster<float>(20, 20), kPixel_m,
                            Raster<float>(20, 20, std::numeric_limits<float>::quiet_NaN()), {}));
}

}  // namespace
}  // namespace palpable::measure
