// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/second_view.hpp"

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
  const auto view = second_view(right, disparity_px);
  EXPECT_EQ(view.picture.width(), kWidth);
  ASSERT_EQ(view.shift.width(), 320);
  ASSERT_EQ(view.shift.height(), 50);
  EXPECT_NEAR(models::shift_share(view.shift(10, 10)), 16.0 / kWidth, 1e-4);
  EXPECT_NEAR(models::shift_share(view.shift(300, 40)), -8.0 / kWidth, 1e-4);
  // A hole takes the values of its rim.
  EXPECT_LT(models::shift_share(view.shift(180, 20)), 16.0F / kWidth);
  EXPECT_GT(models::shift_share(view.shift(180, 20)), -8.0F / kWidth);
}

}  // namespace
}  // namespace palpable::recipes
