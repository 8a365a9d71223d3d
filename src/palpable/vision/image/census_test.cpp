// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/census.hpp"

#include <bit>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A picture of one level with one pixel of another.
Raster<std::uint8_t> one_spot(int x, int y, std::uint8_t level) {
  Raster<std::uint8_t> grey(20, 16, 100);
  grey(x, y) = level;
  return grey;
}

ColourPlanes planes(const Raster<std::uint8_t>& grey) { return {grey, grey, grey}; }

TEST(Census, HasABitForEachPixelDarkerThanTheCentre) {
  const Raster<std::uint64_t> dark = census_9x7(one_spot(10, 8, 50), {});
  for (int y = 5; y <= 11; ++y)
    for (int x = 6; x <= 14; ++x) {
      const bool spot = x == 10 && y == 8;
      EXPECT_EQ(std::popcount(dark(x, y)), spot ? 0 : 1) << x << ' ' << y;
    }
  EXPECT_EQ(dark(5, 8), 0U);  // outside the window
  EXPECT_EQ(std::popcount(census_9x7(one_spot(10, 8, 200), {})(10, 8)), kCensusPixels - 1);
}

TEST(Census, IsIndependentOfTheExposure) {
  Raster<std::uint8_t> grey(20, 16), brighter = grey;
  for (std::size_t i = 0; i < grey.count(); ++i) {
    grey.values()[i] = static_cast<std::uint8_t>(i * 37 % 100);
    brighter.values()[i] = static_cast<std::uint8_t>(2 * grey.values()[i] + 20);
  }
  EXPECT_EQ(census_9x7(grey, {}), census_9x7(brighter, {}));
}

TEST(SimilarPixels, ExcludePixelsOfAnotherColour) {
  const Raster<std::uint64_t> mask = similar_pixels_9x7(planes(one_spot(10, 8, 116)), {}, {});
  EXPECT_EQ(std::popcount(mask(8, 8)), kCensusPixels - 1);
  EXPECT_EQ(std::popcount(mask(3, 8)), kCensusPixels);
  const Raster<std::uint64_t> similar = similar_pixels_9x7(planes(one_spot(10, 8, 115)), {}, {});
  EXPECT_EQ(std::popcount(similar(8, 8)), kCensusPixels);
}

TEST(SimilarPixels, AreAllPixelsIfTooFewAreSimilar) {
  const Raster<std::uint64_t> mask = similar_pixels_9x7(planes(one_spot(10, 8, 200)), {}, {});
  EXPECT_EQ(std::popcount(mask(10, 8)), kCensusPixels);
}

TEST(CensusScale, ScalesADistanceOverSomeBitsToAllBits) {
  EXPECT_EQ(census_scale((std::uint64_t{1} << 21U) - 1U), 3 * kCensusScaleUnit);
  EXPECT_EQ(census_scale((std::uint64_t{1} << 63U) - 1U), kCensusScaleUnit);
}

TEST(Texture, IsAMeanContrastAboveFourLevels) {
  // 63 pixels that differ from the centre by 4 levels are noise, one more level is texture.
  Raster<std::uint8_t> grey(20, 16, 104);
  grey(10, 8) = 100;
  EXPECT_FALSE(has_texture(grey, 10, 8));
  grey(10, 8) = 99;
  EXPECT_TRUE(has_texture(grey, 10, 8));
  EXPECT_FALSE(has_texture(grey, 3, 8));
}

TEST(Shrunk, IsTheMeanOfEachBlock) {
  Raster<std::uint8_t> grey(7, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 7; ++x) grey(x, y) = static_cast<std::uint8_t>(10 * x + y);
  const Raster<std::uint8_t> small = shrunk(grey, 2);
  ASSERT_EQ(small.width(), 3);
  ASSERT_EQ(small.height(), 2);
  EXPECT_EQ(small(1, 1), 28);  // (22 + 32 + 23 + 33) / 4, rounded
}

}  // namespace
}  // namespace palpable::vision
