// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/cross_window.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

ColourPlanes of(const Raster<std::uint8_t>& grey) { return {grey, grey, grey}; }

TEST(CrossArms, ReachAsFarAsTheColourIsSimilar) {
  Raster<std::uint8_t> grey(40, 20, 100);
  for (int y = 0; y < 20; ++y)
    for (int x = 24; x < 40; ++x) grey(x, y) = 200;
  const CrossOptions options{.row_reach_px = 9, .column_reach_px = 4, .neighbour_limit = 19};
  const Raster<CrossArms> arms = cross_arms(of(grey), options, {});
  EXPECT_EQ(arms(20, 10).left, 9);
  EXPECT_EQ(arms(20, 10).right, 3);  // up to the edge
  EXPECT_EQ(arms(20, 10).up, 4);
  EXPECT_EQ(arms(20, 2).up, 2);  // up to the picture's border
  EXPECT_EQ(arms(2, 10).left, 2);
}

TEST(CrossArms, AreStricterBeyondTheSureReach) {
  Raster<std::uint8_t> grey(40, 1, 100);
  for (int x = 20; x < 40; ++x) grey(x, 0) = 112;
  const CrossOptions options{
      .row_reach_px = 15, .colour_limit = 20, .sure_reach_px = 6, .colour_limit_beyond = 8};
  const Raster<CrossArms> arms = cross_arms(of(grey), options, {});
  EXPECT_EQ(arms(15, 0).right, 7);  // 12 levels are within 20, not within 8
  EXPECT_EQ(arms(5, 0).right, 14);  // one colour up to the edge
}

TEST(WindowSize, IsRefusedIfItsSumWouldOverflow) {
  EXPECT_TRUE(check_window_size({}).has_value());
  EXPECT_FALSE(check_window_size({.row_reach_px = 18, .column_reach_px = 6}).has_value());
}

/// Two equal pictures of one level, but for a spot in the right one at (20, 10).
MatchInput with_spot() {
  MatchInput input;
  input.left = Raster<Rgb8>(40, 20, Rgb8{100, 100, 100});
  input.left_grey = Raster<std::uint8_t>(40, 20, 100);
  input.right = input.left;
  input.right_grey = input.left_grey;
  input.right(20, 10) = {160, 160, 160};
  input.right_grey(20, 10) = 160;
  input.disparities = 2;
  return input;
}

TEST(AggregatedCosts, AreTheMeansOverTheWindows) {
  // The colour term alone: the spot costs colour_limit * colour_weight at its pixel, 49 pixels share it.
  AggregationOptions options;
  options.cost.census_weight = 0;
  options.cost.colour_limit = 49;
  options.cost.colour_weight = 2;
  options.limit = 144.0F;
  const std::vector<std::uint8_t> costs = aggregated_costs(with_spot(), options, {});
  const auto at = [&](int x, int y, int d) { return costs[static_cast<std::size_t>((y * 40 + x) * 2 + d)]; };
  EXPECT_EQ(at(20, 10, 0), 2);
  EXPECT_EQ(at(23, 13, 0), 2);
  EXPECT_EQ(at(24, 10, 0), 0);
  EXPECT_EQ(at(24, 10, 1), 2);  // at disparity 1 the spot matches one column further right
  EXPECT_EQ(at(17, 10, 1), 0);
}

TEST(AggregatedCosts, AreTruncatedAtTheLimit) {
  AggregationOptions options;
  options.cost.census_weight = 0;
  options.cost.colour_limit = 60;
  options.window = {.row_reach_px = 0, .column_reach_px = 0};
  options.limit = 50.0F;
  const std::vector<std::uint8_t> costs = aggregated_costs(with_spot(), options, {});
  EXPECT_EQ(costs[static_cast<std::size_t>((10 * 40 + 20) * 2)], 50);
  EXPECT_EQ(*std::max_element(costs.begin(), costs.end()), 50);
}

}  // namespace
}  // namespace palpable::vision
