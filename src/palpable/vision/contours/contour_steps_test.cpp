// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_steps.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(HalveAngle, IsTheUnitDirectionOfTheHalfAngle) {
  for (int degrees = -85; degrees <= 85; degrees += 5) {
    const double a = degrees * 3.14159265358979 / 180.0;
    const auto [x, y] = halve_angle(3.0F * static_cast<float>(std::cos(2.0 * a)),
                                    3.0F * static_cast<float>(std::sin(2.0 * a)));
    EXPECT_NEAR(x, std::cos(a), 1e-6) << degrees;
    EXPECT_NEAR(y, std::sin(a), 1e-6) << degrees;
  }
  EXPECT_EQ(halve_angle(0.0F, 0.0F), (std::pair{0.0F, 0.0F}));
}

TEST(Bilinear, IsExactOnAPlaneAndContinuesTheBorder) {
  Raster<float> plane(5, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x) plane(x, y) = 2.0F * static_cast<float>(x) - 3.0F * static_cast<float>(y);
  EXPECT_FLOAT_EQ(bilinear(plane, 1.25F, 2.5F), 2.0F * 1.25F - 3.0F * 2.5F);
  EXPECT_FLOAT_EQ(bilinear(plane, -3.0F, 1.0F), -3.0F);
  EXPECT_FLOAT_EQ(bilinear(plane, 9.0F, 9.0F), 8.0F - 9.0F);
}

/// A horizontal line of strengths along the row y = 10, over a base of 0, its tangent along x.
struct Line {
  Raster<float> strength{60, 21}, tangent_x{60, 21, 1.0F}, tangent_y{60, 21, 0.0F};
  Raster<float> ridges(double threshold, const LineOptions& options = {}) const {
    return ridge_lines(strength, tangent_x, tangent_y, threshold, options, {});
  }
};

TEST(RidgeLines, FollowALineDownToTheShareOfTheThreshold) {
  Line line;
  for (int x = 0; x < 60; ++x) line.strength(x, 10) = x < 30 ? 0.8F : x < 45 ? 0.3F : 0.1F;
  const Raster<float> half = line.ridges(0.5);
  EXPECT_FLOAT_EQ(half(10, 10), 0.8F);
  EXPECT_FLOAT_EQ(half(40, 10), 0.3F);
  EXPECT_EQ(half(50, 10), 0.0F);
  EXPECT_EQ(half(10, 9), 0.0F);
  LineOptions strict;
  strict.followed_share = 1.0;
  EXPECT_EQ(line.ridges(0.5, strict)(40, 10), 0.0F);
}

TEST(RidgeLines, OmitALineThatNeverReachesTheThreshold) {
  Line line;
  for (int x = 0; x < 60; ++x) line.strength(x, 10) = 0.4F;
  const Raster<float> ridges = line.ridges(0.5);
  for (const float s : ridges.values()) EXPECT_EQ(s, 0.0F);
}

}  // namespace
}  // namespace palpable::vision
