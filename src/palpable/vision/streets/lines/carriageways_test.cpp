// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/carriageways.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

CentreLines one_line(double length, double radius_px) {
  return {{{0, 50}, {length, 50}}, {{{{0, 50}, {length, 50}}, 0, 1, radius_px, 0.1}}};
}

double radius_beside(double radius_px, double other_px) {
  const CentreLines a = one_line(200, radius_px);
  const CentreLines b = one_line(200, other_px);
  const std::array<const CentreLines*, 2> colours{&a, &b};
  return carriageway_radii(colours)[0];
}

TEST(Carriageways, AColourThatIsMuchWiderThanTheOthersHasTwo) {
  EXPECT_EQ(radius_beside(11.0, 6.0), 6.0);
  // Two carriageways are at most twice as wide as one.
  EXPECT_EQ(radius_beside(13.0, 6.0), 6.5);
  EXPECT_EQ(radius_beside(8.0, 5.5), 8.0);
}

TEST(Carriageways, TheWidestCommonWidthIsASingleOne) {
  CentreLines graph = one_line(300, 6.0);
  for (const auto& [length, radius] : {std::array{200.0, 9.0}, {200.0, 16.0}, {20.0, 12.0}})
    graph.lines.push_back(one_line(length, radius).lines[0]);
  const std::array<const CentreLines*, 1> colours{&graph};
  // 9 is a wider kind of street, 16 too wide for one, 12 rare.
  EXPECT_NEAR(carriageway_radii(colours)[0], 9.0, 0.01);
}

TEST(Carriageways, ARareWidthOnALargeMapIsCommonByItsLength) {
  CentreLines graph = one_line(4000, 6.0);
  for (const auto& [length, radius] : {std::array{380.0, 8.7}, {500.0, 12.0}})
    graph.lines.push_back(one_line(length, radius).lines[0]);
  const std::array<const CentreLines*, 1> colours{&graph};
  // 12 is wider than one carriageway beside streets of 6, though not beside those of 8.7.
  EXPECT_NEAR(carriageway_radii(colours)[0], 8.7, 0.01);
}

TEST(Carriageways, SlipRoadsAreNarrowerThanACarriageway) {
  CentreLines graph = one_line(800, 9.0);
  for (const auto& [length, radius] : {std::array{300.0, 16.0}, {150.0, 5.0}})
    graph.lines.push_back(one_line(length, radius).lines[0]);
  const CentreLines main = one_line(4000, 6.0);
  const std::array<const CentreLines*, 2> colours{&graph, &main};
  // 16 is two of 9, but more than two of 5.
  EXPECT_NEAR(carriageway_radii(colours)[0], 9.0, 0.01);
}

/// Two streets 14 pixels wide whose middles are `apart` pixels from each other between x = 100 and 300, and
/// meet at both sides of it.
Raster<std::uint8_t> two_streets(double apart) {
  Raster<std::uint8_t> mask(400, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 400; ++x) {
      const double offset = 0.5 * apart * std::clamp((200.0 - std::abs(x - 200.0) - 60.0) / 40.0, 0.0, 1.0);
      mask(x, y) = std::min(std::abs(y - 50.0 - offset), std::abs(y - 50.0 + offset)) <= 7.0 ? 1 : 0;
    }
  return mask;
}

TEST(Carriageways, TwoThatTouchAreTwoLines) {
  const Raster<std::uint8_t> mask = two_streets(10.0);
  const CentreLines lines = centre_lines_of(mask, carriageways_in(mask, 7.5));
  std::array<double, 2> least{1e9, 1e9};
  for (const CentreLine& line : lines.lines)
    for (const MapPoint p : line.points) {
      if (std::abs(p.x - 200) > 80) continue;
      least[0] = std::min(least[0], std::abs(p.y - 45.0));
      least[1] = std::min(least[1], std::abs(p.y - 55.0));
      EXPECT_LT(std::min(std::abs(p.y - 45.0), std::abs(p.y - 55.0)), 1.6) << p.x;
    }
  EXPECT_LT(least[0], 1.0);
  EXPECT_LT(least[1], 1.0);
}

TEST(Carriageways, TwoEndsBesideEachOtherAreNotJoined) {
  Raster<std::uint8_t> mask(400, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 400; ++x) {
      const double beyond = x - std::clamp(x, 80, 320);
      mask(x, y) = std::min(std::hypot(beyond, y - 40.0), std::hypot(beyond, y - 60.0)) <= 13.0 ? 1 : 0;
    }
  for (const CentreLine& line : centre_lines_of(mask, carriageways_in(mask, 13.5)).lines)
    for (const MapPoint p : line.points) EXPECT_GT(std::abs(p.y - 50.0), 2.5) << p.x;
}

TEST(Carriageways, ASmallRoundaboutIsARing) {
  Raster<std::uint8_t> mask(100, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 0; x < 100; ++x) {
      const bool is_street = std::abs(y - 50.0) <= 5.0;
      mask(x, y) = is_street || std::hypot(x - 50.0, y - 50.0) <= 12.0 ? 1 : 0;
    }
  // The island is covered by a symbol: the ring's middle is 7 pixels from its own.
  const CentreLines lines = centre_lines_of(mask, carriageways_in(mask, 5.5));
  double above = 1e9;
  double below = 1e9;
  for (const CentreLine& line : lines.lines)
    for (const MapPoint p : line.points) {
      above = std::min(above, std::hypot(p.x - 50.0, p.y - 43.0));
      below = std::min(below, std::hypot(p.x - 50.0, p.y - 57.0));
    }
  EXPECT_LT(above, 1.6);
  EXPECT_LT(below, 1.6);
}

TEST(Carriageways, ASingleStreetStaysOneLine) {
  for (const double apart : {0.0, 2.0}) {
    const Raster<std::uint8_t> mask = two_streets(apart);
    EXPECT_EQ(centre_lines_of(mask, carriageways_in(mask, 7.5)).lines.size(), 1U) << apart;
  }
}

}  // namespace
}  // namespace palpable::vision
