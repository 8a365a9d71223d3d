// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/even_ribbons.hpp"

#include <array>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Rgb8 kLand{242, 239, 233};
constexpr Rgb8 kCasing{150, 150, 160};
constexpr Rgb8 kSquare{221, 221, 232};

/// Level strips from x = 20 to 180 with casings, in the colour of squares.
struct Strips {
  Raster<Rgb8> picture{200, 200, kLand};
  Raster<std::uint8_t> streets{200, 200};
  CentreLines lines;

  explicit Strips(const std::vector<int>& radii) {
    int middle = 15;
    for (const int radius : radii) {
      CentreLine line{{}, 0, 0, radius + 0.5, 0.1};
      for (int x = 20; x <= 180; ++x) {
        line.points.push_back({static_cast<double>(x), static_cast<double>(middle)});
        for (int v = -radius - 1; v <= radius + 1; ++v)
          picture(x, middle + v) = std::abs(v) > radius ? kCasing : kSquare;
      }
      line.first = static_cast<int>(lines.nodes.size());
      line.last = line.first + 1;
      lines.nodes.push_back(line.points.front());
      lines.nodes.push_back(line.points.back());
      lines.lines.push_back(line);
      middle += 30;
    }
  }
  std::size_t found() const {
    constexpr std::array<double, 2> kStreetRadii{6.5, 9.5};
    return even_ribbons(picture, lines, streets, kStreetRadii, {}, {}).lines.size();
  }
};

TEST(EvenRibbons, OfTheWidthOfStreetsAreStreets) { EXPECT_EQ((Strips{{6, 6, 6, 12}}).found(), 3U); }

TEST(EvenRibbons, OfManyWidthsAreNone) { EXPECT_EQ((Strips{{3, 4, 6, 8, 12}}).found(), 0U); }

TEST(EvenRibbons, OfAWidthThatNoStreetHasAreNone) { EXPECT_EQ((Strips{{4, 4, 4}}).found(), 0U); }

TEST(EvenRibbons, WithoutCasingsAreNone) {
  Strips strips{{6, 6, 6}};
  for (Rgb8& pixel : strips.picture.values())
    if (pixel.r == kCasing.r) pixel = kLand;
  EXPECT_EQ(strips.found(), 0U);
}

TEST(EvenRibbons, BesideAStreetAreNone) {
  Strips strips{{6, 6}};
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 200; ++x) strips.streets(x, y) = 1;
  EXPECT_EQ(strips.found(), 1U);
}

}  // namespace
}  // namespace palpable::vision
