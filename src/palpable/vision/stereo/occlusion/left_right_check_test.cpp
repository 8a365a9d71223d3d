// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The left view of a board at 6 px in columns 10 … 14 before a wall at 2 px; and the right view.
Raster<float> left_view() {
  Raster<float> out(24, 1, 2.0F);
  for (int x = 10; x < 15; ++x) out(x, 0) = 6.0F;
  return out;
}
Raster<float> right_view() {
  Raster<float> out(24, 1, 2.0F);
  for (int x = 4; x < 9; ++x) out(x, 0) = 6.0F;
  return out;
}

/// Columns 6 … 9 of the left view match 4 … 7 of the right one, where the board is; 0 and 1 match nothing.
bool seen_by_both(int x) { return x >= 2 && (x < 6 || x > 9); }

TEST(LeftRightCheck, ConfirmsPixelsThatBothCamerasSee) {
  const Raster<float> confirmed = left_right_check(left_view(), right_view());
  for (int x = 0; x < 24; ++x) EXPECT_EQ(confirmed(x, 0), seen_by_both(x) ? 1.0F : 0.0F) << x;
}

TEST(LeftRightCheck, OfARowIsTheSame) {
  const Raster<float> left = left_view(), right = right_view(), whole = left_right_check(left, right);
  std::array<std::uint8_t, 24> confirmed{};
  left_right_check_row(left.row(0), right.row(0), 0, confirmed);
  for (std::size_t x = 0; x < 24; ++x)
    EXPECT_EQ(confirmed[x], whole(static_cast<int>(x), 0) > 0.0F ? 1 : 0) << x;
}

TEST(LeftRightCheck, ToleratesOnePixel) {
  Raster<float> right = right_view();
  right(18, 0) = 3.0F;
  right(19, 0) = 3.1F;
  const Raster<float> confirmed = left_right_check(left_view(), right);
  EXPECT_EQ(confirmed(20, 0), 1.0F);
  EXPECT_EQ(confirmed(21, 0), 0.0F);
}

TEST(LeftRightCheck, ConfirmsNothingOutsideTheOtherPicture) {
  Raster<float> right = right_view();
  mask_columns_before(4, right);
  const Raster<float> confirmed = left_right_check(left_view(), right);
  EXPECT_EQ(confirmed(5, 0), 0.0F);
  EXPECT_EQ(confirmed(10, 0), 1.0F);
  std::array<std::uint8_t, 24> row{};
  left_right_check_row(left_view().row(0), right_view().row(0), 4, row);
  EXPECT_EQ(row[5], 0);
  EXPECT_EQ(row[10], 1);
}

TEST(Quantile, IsThatOfTheValuesWithWeight) {
  Raster<float> values(5, 1), weight(5, 1, 1.0F);
  for (int x = 0; x < 5; ++x) values(x, 0) = static_cast<float>(10 * x);
  weight(4, 0) = 0.0F;
  EXPECT_EQ(quantile_where(values, weight, 1.0), 30.0F);
  EXPECT_EQ(quantile_where(values, weight, 0.0), 0.0F);
  EXPECT_EQ(quantile_where(values, Raster<float>(5, 1), 0.5), 0.0F);
}

}  // namespace
}  // namespace palpable::vision
