// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/straight_text.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(StraightText, TheStreetBetweenHalosIsGround) {
  constexpr Rgb8 kHalo{235, 235, 235}, kStreet{137, 137, 137}, kInk{15, 15, 15};
  Raster<Rgb8> picture(80, 40, kHalo);
  for (int y = 15; y < 25; ++y)
    for (int x = 20; x < 60; ++x) {
      if (x % 10 < 2) picture(x, y) = kInk;
      if (x % 10 >= 5 && x % 10 < 8) picture(x, y) = kStreet;
    }
  TextLine line;
  for (int x = 18; x < 60; ++x) line.centre.push_back({static_cast<double>(x), 19.5});
  line.height_px = 10.0;
  line.colour = kInk;
  const auto middle_part = [&](std::span<const Rgb8> grounds, StraightText::Kind kind) {
    const ReadTextOptions options;
    const cv::Mat seen = StraightText(picture, grounds, options).of(line, false, kind);
    const int row = seen.rows / 2;
    int dark = 0, grey = 0;
    for (int x = 0; x < seen.cols; ++x) {
      const int level = seen.at<std::uint8_t>(row, x);
      dark += level < 60 ? 1 : 0;
      grey += level >= 100 && level < 190 ? 1 : 0;
    }
    return std::array{dark, grey};
  };
  const std::array grounds{kStreet, Rgb8{30, 30, 30}};
  for (const auto kind : {StraightText::Kind::strokes, StraightText::Kind::sharpened}) {
    const auto [dark, grey] = middle_part({}, kind);
    const auto [dark_with, grey_with] = middle_part(grounds, kind);
    EXPECT_GT(dark, 10);
    EXPECT_NEAR(dark_with, dark, 0.25 * dark) << "an area like the ink is no ground";
    EXPECT_LT(2 * grey_with, grey);
  }
}

}  // namespace
}  // namespace palpable::vision
