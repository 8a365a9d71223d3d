// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/level_lines.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable {
namespace {

TEST(LevelLines, OfAConeAreClosedRings) {
  Raster<float> cone(61, 61);
  for (int y = 0; y < 61; ++y)
    for (int x = 0; x < 61; ++x) cone(x, y) = static_cast<float>(30.0 - std::hypot(x - 30.0, y - 30.0));
  const auto lines = level_lines(cone, 10.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_EQ(lines[0].front().x, lines[0].back().x);
  EXPECT_EQ(lines[0].front().y, lines[0].back().y);
  for (const RasterPoint p : lines[0]) EXPECT_NEAR(std::hypot(p.x - 30.0, p.y - 30.0), 20.0, 0.02);
}

TEST(LevelLines, EndAtTheBorder) {
  Raster<float> slope(4, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 4; ++x) slope(x, y) = static_cast<float>(x);
  const auto lines = level_lines(slope, 1.25);
  ASSERT_EQ(lines.size(), 1U);
  ASSERT_EQ(lines[0].size(), 3U);
  for (const RasterPoint p : lines[0]) EXPECT_EQ(p.x, 1.25);
}

TEST(LevelLines, AtASaddleConnectTheCornersOnTheMeansSide) {
  Raster<float> saddle(2, 2, 0.0F);
  saddle(0, 0) = saddle(1, 1) = 3.0F;
  // The mean, 1.5, is above 1: the high corners are connected, and each line separates a low one.
  for (const auto& line : level_lines(saddle, 1.0)) {
    ASSERT_EQ(line.size(), 2U);
    const double x = 0.5 * (line[0].x + line[1].x), y = 0.5 * (line[0].y + line[1].y);
    EXPECT_NEAR(std::abs(x - y), 2.0 / 3.0, 1e-9);
  }
  EXPECT_EQ(level_lines(saddle, 1.0).size(), 2U);
}

TEST(LevelLines, AreNoneWhereTheLevelIsNotReached) {
  EXPECT_TRUE(level_lines(Raster<float>(5, 5, 1.0F), 2.0).empty());
}

}  // namespace
}  // namespace palpable
