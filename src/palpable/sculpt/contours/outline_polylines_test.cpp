// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/contours/outline_polylines.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kOutlinePixel_m = 0.0005;

/// A circle of 30 px around the middle of 101 x 81 px.
Raster<float> circle() {
  Raster<float> line(101, 81);
  for (int k = 0; k < 4000; ++k) {
    const double a = 2.0 * std::numbers::pi * k / 4000;
    line(static_cast<int>(std::lround(50 + 30 * std::cos(a))),
         static_cast<int>(std::lround(40 + 30 * std::sin(a)))) = 1.0F;
  }
  return line;
}

TEST(OutlinePolylines, OfACircleIsOneClosedLineOfItsLength) {
  const auto lines = outline_polylines(circle(), kOutlinePixel_m);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines[0].closed);
  EXPECT_NEAR(length_of(lines[0]), 2.0 * std::numbers::pi * 30 * kOutlinePixel_m,
              0.03 * 2.0 * std::numbers::pi * 30 * kOutlinePixel_m);
  for (const Vec3& p : lines[0].points)
    EXPECT_NEAR(std::hypot(p.x, p.y), 30 * kOutlinePixel_m, 0.8 * kOutlinePixel_m);
  EXPECT_LT(lines[0].points.size(), 60U);
}

TEST(OutlinePolylines, OfAnOpenLineRunFromEndToEndWithYUp) {
  Raster<float> line(101, 81);
  for (int x = 10; x <= 90; ++x) line(x, 20) = 1.0F;
  const auto lines = outline_polylines(line, kOutlinePixel_m);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines[0].closed);
  ASSERT_EQ(lines[0].points.size(), 2U);
  EXPECT_NEAR(lines[0].points[0].x, -40 * kOutlinePixel_m, 1e-12);
  EXPECT_NEAR(lines[0].points[1].x, 40 * kOutlinePixel_m, 1e-12);
  EXPECT_NEAR(lines[0].points[0].y, 20 * kOutlinePixel_m, 1e-12);
}

TEST(OutlinePolylines, MeetAtJunctionsWithoutAGap) {
  Raster<float> line(101, 81);
  for (int x = 10; x <= 90; ++x) line(x, 40) = 1.0F;
  for (int y = 41; y <= 70; ++y) line(50, y) = 1.0F;
  const auto lines = outline_polylines(line, kOutlinePixel_m);
  ASSERT_EQ(lines.size(), 2U);
  double nearest = 1.0;
  for (const Vec3& p : lines[1].points) nearest = std::min(nearest, std::abs(p.y));
  EXPECT_LE(nearest, kOutlinePixel_m);
}

TEST(OutlinePolylines, LeaveOutWhatIsShorterThanAsked) {
  Raster<float> line(101, 81);
  for (int x = 10; x <= 16; ++x) line(x, 20) = 1.0F;
  EXPECT_TRUE(outline_polylines(line, kOutlinePixel_m).empty());
  EXPECT_EQ(outline_polylines(line, kOutlinePixel_m, {0.001, 0.0002}).size(), 1U);
}

}  // namespace
}  // namespace palpable::sculpt
