// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/matching_cost.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Both pictures plain, the right one by `levels` brighter.
MatchInput plain_pair(std::uint8_t levels) {
  MatchInput input;
  const auto right = static_cast<std::uint8_t>(100 + levels);
  input.left = Raster<Rgb8>(24, 9, Rgb8{100, 100, 100});
  input.right = Raster<Rgb8>(24, 9, Rgb8{right, 100, 100});
  input.left_grey = input.right_grey = Raster<std::uint8_t>(24, 9, 100);
  input.disparities = 8;
  return input;
}

std::vector<std::uint8_t> row_of(const MatchInput& input, const CostOptions& options, int y, int stride) {
  std::vector<std::uint8_t> out(static_cast<std::size_t>(24 * stride));
  MatchingCost(input, options, {}).fill_row(y, stride, out.data());
  return out;
}

TEST(MatchingCosts, AreTheWeightedColourDifferenceOfPlainPictures) {
  const CostOptions options{.colour_limit = 20, .colour_weight = 3};
  EXPECT_EQ(row_of(plain_pair(7), options, 4, 64)[20 * 64 + 5], 21);
  EXPECT_EQ(row_of(plain_pair(90), options, 4, 64)[20 * 64 + 5], 60);  // cut off
}

TEST(MatchingCosts, AreHalvedTheGivenNumberOfTimes) {
  const CostOptions options{.colour_limit = 20, .colour_weight = 3, .halvings = 2};
  EXPECT_EQ(row_of(plain_pair(7), options, 4, 64)[20 * 64 + 5], 5);
}

TEST(MatchingCosts, CountTheCensusBitsThatDiffer) {
  // The right picture's luma has a dark pixel within the window of one signature: one bit of 63 differs.
  MatchInput input = plain_pair(0);
  input.right_grey(18, 5) = 50;
  const CostOptions options{.census_weight = 2, .colour_weight = 0};
  EXPECT_EQ(row_of(input, options, 4, 64)[20 * 64 + 4], 2);  // its match, at 16, has the pixel in its window
  EXPECT_EQ(row_of(input, options, 4, 64)[20 * 64 + 7], 0);  // that at 13 does not
}

TEST(MatchingCosts, AreBetweenLeastAndMeanOutsideThePicture) {
  MatchInput input = plain_pair(7);
  input.right(0, 4) = {100, 100, 100};
  const CostOptions options{.census_weight = 0, .colour_limit = 20, .colour_weight = 4, .out_of_view = 0.5F};
  const std::vector<std::uint8_t> row = row_of(input, options, 4, 64);
  // At x = 3 the costs of d = 0, 1, 2, 3 are 28, 28, 28 and 0: mean 21, least 0.
  EXPECT_EQ(row[3 * 64 + 3], 0);
  EXPECT_EQ(row[3 * 64 + 4], 10);
  EXPECT_EQ(row[3 * 64 + 9], 10);
}

}  // namespace
}  // namespace palpable::vision
