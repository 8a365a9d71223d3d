// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/picture_pyramid.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(HalvedPair, HasTheMeansOfFourAndHalfTheDisparities) {
  MatchInput input;
  input.left = Raster<Rgb8>(5, 4);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 5; ++x)
      input.left(x, y) = {static_cast<std::uint8_t>(10 * x), static_cast<std::uint8_t>(4 * y), 40};
  input.right = input.left;
  input.disparities = 21;
  input.right_first = 7;
  const MatchInput half = halved(input);
  ASSERT_EQ(half.left.width(), 3);
  ASSERT_EQ(half.left.height(), 2);
  EXPECT_EQ(half.left(1, 1).r, 25);
  EXPECT_EQ(half.left(1, 1).g, 10);
  EXPECT_EQ(half.left(2, 0).r, 40);  // the last column by itself
  EXPECT_EQ(half.disparities, 11);
  EXPECT_EQ(half.right_first, 3);
  // The luma of (25, 10, 40).
  EXPECT_NEAR(half.left_grey(1, 1), 0.299 * 25 + 0.587 * 10 + 0.114 * 40, 1.0);
}

}  // namespace
}  // namespace palpable::vision
