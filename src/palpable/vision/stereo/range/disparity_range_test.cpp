// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/range/disparity_range.hpp"

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A picture of the texture, shifted to the left by d(y).
template <class Disparity>
Raster<std::uint8_t> moved(int width, int height, const Disparity& d) {
  Raster<std::uint8_t> out(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      out(x, y) = static_cast<std::uint8_t>(std::lround(255.0 * texture(x + d(y), y, 0)));
  return out;
}

TEST(DisparityRange, ContainsThePairsDisparitiesWithASmallMargin) {
  // The upper half lies at 5 px, the lower one at 23.
  const auto left = moved(200, 100, [](int) { return 0; });
  const auto right = moved(200, 100, [](int y) { return y < 50 ? 5 : 23; });
  const DisparityRange range = find_disparity_range(left, right, {}, {});
  EXPECT_LE(range.min_px, 5);
  EXPECT_GE(range.min_px, 0);
  EXPECT_GE(range.max_px, 23);
  EXPECT_LE(range.max_px, 30);
  EXPECT_GT(range.agreement, 0.5);
  EXPECT_GT(range.textured, 0.9 * (192.0 / 200.0));
}

TEST(DisparityRange, FindsNegativeDisparities) {
  const auto left = moved(200, 100, [](int) { return 0; });
  const auto right = moved(200, 100, [](int) { return -12; });
  const DisparityRange range = find_disparity_range(left, right, {}, {});
  EXPECT_LE(range.min_px, -12);
  EXPECT_LT(range.max_px, 0);
}

TEST(DisparityRange, OfUnrelatedPicturesHasLittleAgreement) {
  const auto left = moved(200, 100, [](int) { return 0; });
  const auto other = moved(200, 100, [](int) { return 5000; });
  EXPECT_LT(find_disparity_range(left, other, {}, {}).agreement, 0.08);
}

TEST(DisparityRange, BeginsNearInfinityIfMostOfThePictureHasNoTexture) {
  const auto band = [](Raster<std::uint8_t> picture) {
    for (int y = 0; y < 100; ++y)
      for (int x = 0; x < 200; ++x)
        if (y < 40 || y >= 60) picture(x, y) = 90;
    return picture;
  };
  const auto left = moved(200, 100, [](int) { return 0; });
  const auto right = moved(200, 100, [](int) { return 23; });
  EXPECT_GT(find_disparity_range(left, right, {}, {}).min_px, 15);
  const DisparityRange range = find_disparity_range(band(left), band(right), {}, {});
  EXPECT_LT(range.textured, 0.4);
  EXPECT_LE(range.min_px, 23 * 0.8);
  EXPECT_GE(range.min_px, 0);
  EXPECT_GE(range.max_px, 23);
}

TEST(DisparityRange, OfPlainPicturesFindsNoTexture) {
  const Raster<std::uint8_t> plain(200, 100, 90);
  const DisparityRange range = find_disparity_range(plain, plain, {}, {});
  EXPECT_EQ(range.textured, 0.0);
  EXPECT_EQ(range.agreement, 0.0);
}

}  // namespace
}  // namespace palpable::vision
