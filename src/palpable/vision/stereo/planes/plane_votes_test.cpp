// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/plane_votes.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kVotesWidth = 90;
constexpr int kVotesHeight = 40;
/// A wall that gets nearer to the right, and in front of it a board from this column on in the left view.
constexpr int kBoard = 60;
constexpr float kBoard_px = 30.0F;
float wall_px(int x) { return 5.0F + 0.1F * static_cast<float>(x); }

/// The right view: the board, else the wall.
Raster<float> seen_from_right() {
  Raster<float> out(kVotesWidth, kVotesHeight);
  for (int y = 0; y < kVotesHeight; ++y)
    for (int x = 0; x < kVotesWidth; ++x) {
      const bool board = static_cast<float>(x) >= static_cast<float>(kBoard) - kBoard_px;
      // x_left = x + d and d = 5 + x_left / 10 give d = (5 + x / 10) / 0.9.
      out(x, y) = board ? kBoard_px : (5.0F + 0.1F * static_cast<float>(x)) / 0.9F;
    }
  return out;
}

bool is_hidden(int x) {
  return x < kBoard && static_cast<float>(x) - wall_px(x) >= static_cast<float>(kBoard) - kBoard_px;
}

ColourPlanes grey() {
  const Raster<std::uint8_t> even(kVotesWidth, kVotesHeight, std::uint8_t{90});
  return {even, even, even};
}

/// The truth, but with `hidden_px(x)` where the board hides the wall.
template <class Hidden>
PlaneMap map_with(const Hidden& hidden_px) {
  PlaneMap map(kVotesWidth, kVotesHeight);
  for (int y = 0; y < kVotesHeight; ++y)
    for (int x = 0; x < kVotesWidth; ++x) {
      const bool wall = x < kBoard && !is_hidden(x);
      map.disparity(x, y) = x >= kBoard ? kBoard_px : wall ? wall_px(x) : hidden_px(x);
      map.slope_x(x, y) = wall ? 0.1F : 0.0F;
    }
  return map;
}

/// The truth, but two columns of row 10 are farther.
PlaneMap map_with_pit(float depth_px = 3.0F) {
  PlaneMap map = map_with(wall_px);
  for (const int x : {20, 21}) map.disparity(x, 10) -= depth_px;
  return map;
}

void fill_pits_of(const ColourPlanes& colour, PlaneMap& map) {
  fill_pits(colour, seen_from_right(), {}, kContradictedWindow, map, {});
}

TEST(PlaneVotes, FillAPitThatNoStepExplains) {
  PlaneMap map = map_with_pit();
  fill_pits_of(grey(), map);
  for (const int x : {20, 21}) EXPECT_NEAR(map.disparity(x, 10), wall_px(x), 0.1F) << x;
}

TEST(PlaneVotes, KeepADeepGap) {
  PlaneMap map = map_with_pit(5.0F);
  fill_pits_of(grey(), map);
  EXPECT_EQ(map.disparity, map_with_pit(5.0F).disparity);
}

TEST(PlaneVotes, KeepAPitOfItsOwnColour) {
  PlaneMap map = map_with_pit();
  ColourPlanes colour = grey();
  for (const int x : {20, 21}) colour.r(x, 10) = 200;
  fill_pits_of(colour, map);
  EXPECT_EQ(map.disparity, map_with_pit().disparity);
}

TEST(PlaneVotes, AreNoPitsWhereTheBoardHidesTheWall) {
  PlaneMap map = map_with(wall_px);
  fill_pits_of(grey(), map);
  EXPECT_EQ(map.disparity, map_with(wall_px).disparity);
}

TEST(PlaneVotes, ContinueTheWallBehindTheBoard) {
  // Like the search's result: a slope between the wall and the board.
  PlaneMap map = map_with([](int x) { return 11.0F + 0.5F * static_cast<float>(x - kBoard + 18); });
  continue_background(grey(), seen_from_right(), {}, map, {});
  int hidden = 0;
  for (int y = 0; y < kVotesHeight; ++y)
    for (int x = 0; x < kVotesWidth; ++x) {
      hidden += is_hidden(x);
      EXPECT_NEAR(map.disparity(x, y), x < kBoard ? wall_px(x) : kBoard_px, 0.01F) << x << ", " << y;
    }
  EXPECT_EQ(hidden, 21 * kVotesHeight);
}

TEST(PlaneVotes, ReplaceAContradictedDisparity) {
  PlaneMap map = map_with(wall_px);
  map.disparity(20, 20) = 14.0F;
  EXPECT_NEAR(replace_contradicted(grey(), seen_from_right(), kContradictedWindow, map, {})(20, 20),
              wall_px(20), 0.01F);
}

TEST(PlaneVotes, KeepOccludedAndConfirmedPixels) {
  const PlaneMap map = map_with([](int x) { return wall_px(x) - 3.0F; });
  const Raster<float> after = replace_contradicted(grey(), seen_from_right(), kContradictedWindow, map, {});
  for (int y = 0; y < kVotesHeight; ++y)
    for (int x = 20; x < kVotesWidth; ++x) EXPECT_EQ(after(x, y), map.disparity(x, y)) << x << ", " << y;
}

}  // namespace
}  // namespace palpable::vision
