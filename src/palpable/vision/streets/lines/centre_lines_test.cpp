// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The pixels of a picture of this size for which is_set(x, y).
template <class IsSet>
Raster<std::uint8_t> mask_where(int width, int height, const IsSet& is_set) {
  Raster<std::uint8_t> mask(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) mask(x, y) = is_set(x, y) ? 1 : 0;
  return mask;
}

CentreLine straight_line(MapPoint from, MapPoint to, int first, int last, double radius_px) {
  CentreLine line{{}, first, last, radius_px, 0.0};
  const int steps = static_cast<int>(std::lround(std::hypot(to.x - from.x, to.y - from.y)));
  for (int i = 0; i <= steps; ++i)
    line.points.push_back({from.x + (to.x - from.x) * i / steps, from.y + (to.y - from.y) * i / steps});
  return line;
}

TEST(CentreLines, OfABarAreItsMiddle) {
  // Rows 15 to 25: the middle is row 20, and the nearest unset pixel is 6 rows away.
  const auto graph = centre_lines_of(mask_where(120, 40, [](int, int y) { return y >= 15 && y <= 25; }));
  ASSERT_EQ(graph.lines.size(), 1U);
  const CentreLine& line = graph.lines[0];
  for (const MapPoint p : line.points) EXPECT_NEAR(p.y, 20.0, 1.0) << p.x;
  EXPECT_NEAR(line.radius_px, 6.0, 0.3);
  EXPECT_LT(line.radius_spread_px, 0.5);
  // Thinning takes at most half of the width from each end.
  EXPECT_GT(length_px(line.points), 119.0 - 2.0 * 6.0);
}

TEST(CentreLines, OfACrossMeetInItsMiddle) {
  const auto graph = centre_lines_of(
      mask_where(141, 101, [](int x, int y) { return std::abs(x - 70) <= 4 || std::abs(y - 50) <= 4; }));
  const auto degrees = degrees_of(graph);
  ASSERT_EQ(graph.lines.size(), 4U);
  EXPECT_EQ(std::count(degrees.begin(), degrees.end(), 1), 4);
  const auto crossing = std::find(degrees.begin(), degrees.end(), 4);
  ASSERT_NE(crossing, degrees.end());
  const MapPoint at = graph.nodes[static_cast<std::size_t>(crossing - degrees.begin())];
  EXPECT_NEAR(at.x, 70.0, 1.5);
  EXPECT_NEAR(at.y, 50.0, 1.5);
}

TEST(CentreLines, OfARingAreACircle) {
  constexpr double kRadius = 40.0;
  const auto graph = centre_lines_of(mask_where(
      101, 101, [](int x, int y) { return std::abs(std::hypot(x - 50, y - 50) - kRadius) <= 4.0; }));
  ASSERT_EQ(graph.lines.size(), 1U);
  EXPECT_EQ(graph.lines[0].first, graph.lines[0].last);
  for (const MapPoint p : graph.lines[0].points)
    EXPECT_NEAR(std::hypot(p.x - 50.0, p.y - 50.0), kRadius, 1.5);
  // A line of pixels is at most 1.08 times as long as the circle (Freeman 1970).
  const double circle = 2.0 * std::numbers::pi * kRadius;
  EXPECT_NEAR(length_px(graph.lines[0].points), 1.04 * circle, 0.04 * circle);
}

TEST(CentreLines, ARaggedBorderMakesNoBranches) {
  const auto graph = centre_lines_of(mask_where(200, 60, [](int x, int y) {
    const bool is_bump = y == 19 && x % 7 < 3, is_notch = y == 40 && x % 11 < 4;
    return (y >= 20 && y <= 40 && !is_notch) || is_bump;
  }));
  EXPECT_EQ(graph.lines.size(), 1U);
}

TEST(CentreLines, LoseTheirSpursAndAreJoinedThere) {
  CentreLines graph;
  graph.nodes = {{0, 0}, {50, 0}, {100, 0}, {50, 8}};
  graph.lines = {straight_line(graph.nodes[0], graph.nodes[1], 0, 1, 4.0),
                 straight_line(graph.nodes[1], graph.nodes[2], 1, 2, 4.0),
                 straight_line(graph.nodes[1], graph.nodes[3], 1, 3, 4.0)};
  CentreLines kept = graph;
  remove_spurs(kept, 1.0, 2.0);
  EXPECT_EQ(kept.lines.size(), 3U) << "8 px are more than 1 * 4 + 2";
  remove_spurs(graph, 2.0, 2.0);
  ASSERT_EQ(graph.lines.size(), 1U) << "8 px are less than 2 * 4 + 2";
  EXPECT_NEAR(length_px(graph.lines[0].points), 100.0, 1e-9);
}

TEST(CentreLines, LoseShortNetworks) {
  CentreLines graph;
  graph.nodes = {{0, 0}, {50, 0}, {0, 50}, {12, 50}, {24, 50}};
  graph.lines = {straight_line(graph.nodes[0], graph.nodes[1], 0, 1, 2.0),
                 straight_line(graph.nodes[2], graph.nodes[3], 2, 3, 2.0),
                 straight_line(graph.nodes[3], graph.nodes[4], 3, 4, 2.0)};
  CentreLines all = graph;
  remove_short_networks(all, 23.0, 0.0);
  EXPECT_EQ(all.lines.size(), 3U) << "12 + 12 px hang together";
  remove_short_networks(graph, 25.0, 0.0);
  ASSERT_EQ(graph.lines.size(), 1U);
  remove_short_networks(graph, 0.0, 26.0);
  EXPECT_TRUE(graph.lines.empty()) << "50 px are less than 26 radii";
}

TEST(CentreLines, AreSimplifiedWithinTheError) {
  std::vector<MapPoint> corner;
  for (int i = 0; i <= 30; ++i) corner.push_back({static_cast<double>(i), 0.0});
  for (int i = 1; i <= 20; ++i) corner.push_back({30.0, static_cast<double>(i)});
  const auto two_sides = simplified(corner, 0.4);
  ASSERT_EQ(two_sides.size(), 3U);
  EXPECT_EQ(two_sides[1].x, 30.0);
  EXPECT_EQ(two_sides[1].y, 0.0);
  std::vector<MapPoint> arc;
  for (int i = 0; i <= 100; ++i) {
    const double angle = std::numbers::pi * i / 100.0;
    arc.push_back({50.0 * std::cos(angle), 50.0 * std::sin(angle)});
  }
  const auto chords = simplified(arc, 0.5);
  EXPECT_LT(chords.size(), 20U);
  for (std::size_t i = 1; i < chords.size(); ++i) {
    // The arc is farthest from a chord above its middle.
    const double half = 0.5 * std::hypot(chords[i].x - chords[i - 1].x, chords[i].y - chords[i - 1].y);
    EXPECT_LE(50.0 - std::sqrt(50.0 * 50.0 - half * half), 0.5 + 1e-6);
  }
}

TEST(CentreLines, AreSmoothedWithoutMovingTheirEnds) {
  std::vector<MapPoint> stairs;
  for (int i = 0; i <= 40; ++i) stairs.push_back({static_cast<double>(i), i % 2 == 0 ? 1.0 : -1.0});
  const auto mean = smoothed(stairs, 3);
  EXPECT_EQ(mean.front().y, 1.0);
  EXPECT_EQ(mean.back().y, 1.0);
  // Of seven points in turn four lie on one side.
  for (std::size_t i = 3; i + 3 < mean.size(); ++i) EXPECT_NEAR(std::abs(mean[i].y), 1.0 / 7.0, 1e-12);
  for (std::size_t i = 0; i < mean.size(); ++i) EXPECT_NEAR(mean[i].x, static_cast<double>(i), 1e-12);
}

}  // namespace
}  // namespace palpable::vision
