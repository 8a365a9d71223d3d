// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/regions.hpp"

#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A red disc on blue, with grain.
Raster<Rgb8> disc() {
  Raster<Rgb8> picture(120, 90);
  std::mt19937 random(5);
  std::uniform_int_distribution<int> grain(-6, 6);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool in = (x - 60) * (x - 60) + (y - 45) * (y - 45) < 30 * 30;
      const int g = grain(random);
      picture(x, y) = {static_cast<std::uint8_t>((in ? 190 : 40) + g), static_cast<std::uint8_t>(60 + g),
                       static_cast<std::uint8_t>((in ? 50 : 170) + g)};
    }
  return picture;
}

TEST(MergeRegions, SeparatesADiscFromItsBackground) {
  const Regions regions = merge_regions(disc());
  ASSERT_EQ(regions.count(), 2);
  EXPECT_NE(regions.of_pixel(60, 45), regions.of_pixel(2, 2));
  EXPECT_EQ(regions.of_pixel(2, 2), regions.of_pixel(117, 87));
  EXPECT_NEAR(regions.pixels[static_cast<std::size_t>(regions.of_pixel(60, 45))], 3.14159 * 900, 30);
}

TEST(MergeRegions, DivideARampIntoMoreRegionsWithLargerComplexity) {
  Raster<Rgb8> ramp(240, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 240; ++x) {
      const auto level = static_cast<std::uint8_t>(x);
      ramp(x, y) = {level, level, level};
    }
  EXPECT_GT(merge_regions(ramp, 1024.0).count(), merge_regions(ramp, 1.0).count());
}

}  // namespace
}  // namespace palpable::vision
