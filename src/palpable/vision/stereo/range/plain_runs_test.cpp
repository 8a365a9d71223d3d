// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/range/plain_runs.hpp"

#include "palpable/vision/stereo/problem/centred_box.hpp"
#include "palpable/vision/stereo/problem/prepare_pictures.hpp"
#include "palpable/vision/stereo/range/disparity_range.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A board of one colour, 60 px nearer than a textured wall at 6 px.
MatchInput board_before_wall(float level) {
  SyntheticScene scene;
  scene.width = 240;
  scene.height = 120;
  scene.box_left = scene.box_right = 0;
  StereoPair pair = render(scene);
  for (int y = 30; y < 100; ++y)
    for (int x = 110; x < 190; ++x) {
      pair.left.samples[static_cast<std::size_t>(y * scene.width + x)] = level;
      pair.right.samples[static_cast<std::size_t>(y * scene.width + x - 66)] = level;
    }
  return prepare_pictures(pair, Work{});
}

TEST(PlainRuns, FindTheDisparityOfABoardOfOneColour) {
  const MatchInput input = board_before_wall(0.95F);
  const std::vector<int> pixels = plain_run_disparities(input.left_grey, input.right_grey, {}, Work{});
  EXPECT_EQ(std::max_element(pixels.begin(), pixels.end()) - pixels.begin(), 66);
  EXPECT_GT(pixels[66], 60 * 80);
}

TEST(PlainRuns, ExtendTheAutomaticRange) {
  const MatchInput input = board_before_wall(0.95F);
  RangeOptions options;
  options.share_beyond_gap = 1.0;  // as if windows on the board's outline had no match
  const DisparityRange range = find_disparity_range(input.left_grey, input.right_grey, options, Work{});
  EXPECT_GE(range.max_px, 67);
  EXPECT_LE(range.max_px, 72);
  options.plain_share = 1.0;
  EXPECT_LT(find_disparity_range(input.left_grey, input.right_grey, options, Work{}).max_px, 40);
}

TEST(PlainRuns, LeaveTheRangeOfTexturedAndRepeatedPictures) {
  const SyntheticScene scene = centred_box_scene(200, 120);
  const MatchInput textured = prepare_pictures(render(scene), Work{});
  Raster<std::uint8_t> stripes(200, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 200; ++x) stripes(x, y) = x / 12 % 2 == 0 ? 60 : 200;
  for (const auto& [left, right] : {std::pair{textured.left_grey, textured.right_grey}, {stripes, stripes}}) {
    const std::vector<int> pixels = plain_run_disparities(left, right, {}, Work{});
    EXPECT_EQ(std::count(pixels.begin(), pixels.end(), 0), static_cast<std::ptrdiff_t>(pixels.size()));
  }
}

}  // namespace
}  // namespace palpable::vision
