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

TEST(StraightText, CoverageShowsNoBordersInAnotherColour) {
  constexpr Rgb8 kInk{30, 30, 30}, kBorder{160, 107, 0};
  TextLine line;
  line.height_px = 10.0;
  line.colour = kInk;
  for (int x = 18; x < 60; ++x) line.centre.push_back({static_cast<double>(x), 19.5});
  const auto dark = [&](bool bordered, StraightText::Kind kind) {
    Raster<Rgb8> picture(80, 40, {250, 240, 220});
    for (int x = 18; x < 60; ++x) {
      if (bordered) picture(x, 15) = kBorder;
      if (x % 10 < 2)
        for (int y = 16; y < 25; ++y) picture(x, y) = kInk;
    }
    return cv::countNonZero(StraightText(picture, {}, {}).of(line, false, kind) < 160);
  };
  using Kind = StraightText::Kind;
  EXPECT_GT(dark(true, Kind::strokes), 1.2 * dark(false, Kind::strokes));
  EXPECT_NEAR(dark(true, Kind::covered), dark(false, Kind::covered), 0.05 * dark(false, Kind::covered));
}

}  // namespace
}  // namespace palpable::vision
