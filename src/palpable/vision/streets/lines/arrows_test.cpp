// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/arrows.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Rgb8 kStreet{255, 255, 255};

/// Radius of a carriageway of a street along y = 50 that is 40 pixels wide, with dark strokes of `width` x
/// `height` pixels in the middles `at`; 20 if they tell none.
double radius_by(const std::vector<MapPoint>& at, int width = 10, int height = 3) {
  Raster<Rgb8> picture(200, 100, {240, 238, 232});
  Raster<std::uint8_t> mask(200, 100);
  for (int y = 30; y <= 70; ++y)
    for (int x = 0; x < 200; ++x) {
      picture(x, y) = kStreet;
      mask(x, y) = 1;
    }
  for (const MapPoint p : at)
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x)
        picture(static_cast<int>(p.x) + x - width / 2, static_cast<int>(p.y) + y - height / 2) = {60, 55, 40};
  CentreLines lines{{{0, 50}, {199, 50}}, {{{}, 0, 1, 20.5, 0.1}}};
  for (int x = 0; x < 200; ++x) lines.lines[0].points.push_back({static_cast<double>(x), 50.0});
  return radii_by_arrows(mask, lines, find_arrows(picture, mask, kStreet), 20.0)[0];
}

TEST(Arrows, BesideTheMiddleOfTheirStreetShowTwoCarriageways) {
  EXPECT_NEAR(radius_by({{60, 40}, {140, 60}}), 11.0, 1.0);
}

TEST(Arrows, InTheMiddleShowASingleCarriageway) { EXPECT_EQ(radius_by({{60, 50}, {140, 50}}), 20.0); }

TEST(Arrows, AreNoLettersAndPointAlongTheStreet) {
  // Strokes across the street are none, and letters stand beside each other.
  EXPECT_EQ(radius_by({{60, 40}, {140, 60}}, 3, 10), 20.0);
  EXPECT_EQ(radius_by({{60, 40}, {71, 40}, {140, 60}, {151, 60}}), 20.0);
}

}  // namespace
}  // namespace palpable::vision
