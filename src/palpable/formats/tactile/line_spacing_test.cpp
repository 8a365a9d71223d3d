// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/line_spacing.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::formats {
namespace {

Polyline straight(Vec3 from, Vec3 to) { return {{from, to}, false}; }

Polyline ring(double radius_m, Vec3 middle = {}) {
  Polyline line;
  line.closed = true;
  for (int k = 0; k < 90; ++k) {
    const double a = 2.0 * std::numbers::pi * k / 90.0;
    line.points.push_back({middle.x + radius_m * std::cos(a), middle.y + radius_m * std::sin(a), 0.0});
  }
  return line;
}

TEST(SpacedLines, OfLinesSideBySideTheFirstOneIsLeft) {
  const std::vector<Polyline> lines{straight({-0.05, 0, 0}, {0.05, 0, 0}),
                                    straight({-0.05, 0.002, 0}, {0.05, 0.002, 0}),
                                    straight({-0.05, 0.005, 0}, {0.05, 0.005, 0})};
  const auto spaced = spaced_lines(lines, 0.004);
  ASSERT_EQ(spaced.size(), 3U);
  EXPECT_EQ(spaced[0].size(), 1U);
  EXPECT_TRUE(spaced[1].empty());
  EXPECT_EQ(spaced[2].size(), 1U);
}

TEST(SpacedLines, ALineThatCrossesAnEarlierOneEndsOnItFromBothSides) {
  const std::vector<Polyline> lines{straight({-0.05, 0, 0}, {0.05, 0, 0}),
                                    straight({0, -0.05, 0}, {0, 0.05, 0})};
  const auto spaced = spaced_lines(lines, 0.004);
  ASSERT_EQ(spaced[1].size(), 2U);
  EXPECT_NEAR(spaced[1][0].points.back().y, 0.0, 1e-9);
  EXPECT_NEAR(spaced[1][1].points.front().y, 0.0, 1e-9);
  EXPECT_NEAR(length_of(spaced[1][0]), 0.05, 0.002);
}

TEST(SpacedLines, ALineThatJoinsAnEarlierOneIsDrawnUpToIt) {
  // It comes down to the first line, runs along it and ends.
  const std::vector<Polyline> lines{straight({-0.05, 0, 0}, {0.05, 0, 0}),
                                    {{{-0.02, 0.03, 0}, {-0.02, 0.0005, 0}, {0.04, 0.0005, 0}}, false}};
  const auto spaced = spaced_lines(lines, 0.004);
  ASSERT_EQ(spaced[1].size(), 1U);
  EXPECT_LT(length_of(spaced[1][0]), 0.033);
  EXPECT_NEAR(spaced[1][0].points.back().y, 0.0, 1e-9);
}

TEST(SpacedLines, ClosedLinesStayClosedAndNarrowOnesBecomeOneLine) {
  const auto spaced = spaced_lines(std::vector<Polyline>{ring(0.02)}, 0.004);
  ASSERT_EQ(spaced[0].size(), 1U);
  EXPECT_TRUE(spaced[0][0].closed);
  EXPECT_EQ(spaced[0][0].points.size(), 90U);
  // The outline of a stick: 2 mm wide.
  const Polyline stick{{{0, 0, 0}, {0.04, 0, 0}, {0.04, 0.002, 0}, {0, 0.002, 0}}, true};
  const auto narrow = spaced_lines(std::vector<Polyline>{stick}, 0.004);
  double length_m = 0.0;
  for (const Polyline& piece : narrow[0]) length_m += length_of(piece);
  EXPECT_GT(length_m, 0.035);
  EXPECT_LT(length_m, 0.06);
}

TEST(SpacedLines, PiecesThatNoFingerFindsAreLeftOut) {
  const std::vector<Polyline> lines{ring(0.0015), straight({0.02, 0, 0}, {0.03, 0, 0})};
  const auto spaced = spaced_lines(lines, 0.004);
  EXPECT_TRUE(spaced[0].empty());
  EXPECT_TRUE(spaced[1].empty());
}

TEST(SpacedLines, NoTwoPiecesOfACrowdedDrawingAreTooNear) {
  std::vector<Polyline> lines;
  for (int k = 1; k < 30; ++k) lines.push_back(ring(0.0011 * k, {0.0003 * k, 0, 0}));
  const auto spaced = spaced_lines(lines, 0.004);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < spaced.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      for (const Polyline& one : spaced[i])
        for (const Polyline& other : spaced[j])
          // The ends may meet another line.
          for (std::size_t a = 12; a + 12 < one.points.size(); ++a)
            for (const Vec3 b : other.points) least = std::min(least, norm(one.points[a] - b));
  EXPECT_GT(least, 0.0035);
  EXPECT_LT(least, 0.02);
}

}  // namespace
}  // namespace palpable::formats
