// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/second_view.hpp"

#include <cmath>
#include <cstddef>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

TEST(SecondView, HoldsTheRightPictureAndWhereItShowsEachPlace) {
  constexpr int kWidth = 640, kHeight = 100;
  constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
  Raster<float> disparity_px(kWidth, kHeight, 16.0F);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 320; x < kWidth; ++x) disparity_px(x, y) = x < 400 ? kUnknown : -8.0F;
  Image right{kWidth, kHeight, 3, 8, {}};
  right.samples.assign(std::size_t{3} * kWidth * kHeight, 0.5F);
  const auto view = second_view(right, right, disparity_px);
  EXPECT_EQ(view.picture.width(), kWidth);
  ASSERT_EQ(view.shift.width(), 320);
  ASSERT_EQ(view.shift.height(), 50);
  EXPECT_NEAR(models::shift_share(view.shift(10, 10)), 16.0 / kWidth, 1e-4);
  EXPECT_NEAR(models::shift_share(view.shift(300, 40)), -8.0 / kWidth, 1e-4);
  // A hole takes the values of its rim.
  EXPECT_LT(models::shift_share(view.shift(180, 20)), 16.0F / kWidth);
  EXPECT_GT(models::shift_share(view.shift(180, 20)), -8.0F / kWidth);
}

TEST(SecondView, HasTheLeftPicturesLevelsWhereTheExposuresDiffer) {
  constexpr int kSide = 64;
  Image left{kSide, kSide, 3, 8, {}};
  for (int k = 0; k < 3 * kSide * kSide; ++k)
    left.samples.push_back(0.2F + 0.01F * static_cast<float>(k % 71));
  Image dark = left;
  for (float& level : dark.samples) level *= 0.6F;
  const auto view = second_view(left, dark, Raster<float>(kSide, kSide, 1.0F));
  const auto expected = rgb8(left);
  double difference = 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) difference += std::abs(view.picture(x, y).g - expected(x, y).g);
  EXPECT_LT(difference / (kSide * kSide), 2.0);
}

}  // namespace
}  // namespace palpable::recipes
