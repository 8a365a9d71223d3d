// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/ink.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr std::uint8_t kPaper = 220;

Rgb8 grey(int level) {
  const auto v = static_cast<std::uint8_t>(level);
  return {v, v, v};
}

void fill(Raster<Rgb8>& picture, int left, int top, int width, int height, Rgb8 colour) {
  for (int y = top; y < top + height; ++y)
    for (int x = left; x < left + width; ++x) picture(x, y) = colour;
}

Raster<Rgb8> paper() { return {120, 60, grey(kPaper)}; }

TEST(Ink, IsAsDarkAsItDiffersFromWhatIsAroundIt) {
  Raster<Rgb8> picture = paper();
  fill(picture, 20, 20, 4, 12, grey(100));
  fill(picture, 60, 10, 30, 30, grey(100));
  const cv::Mat darkness = darkness_of(picture, 7);
  EXPECT_EQ(darkness.at<std::uint8_t>(25, 21), kPaper - 100);
  EXPECT_EQ(darkness.at<std::uint8_t>(25, 40), 0) << "paper";
  EXPECT_EQ(darkness.at<std::uint8_t>(25, 75), 0) << "an area is no stroke";
}

TEST(Ink, PiecesHaveTheirPlaceSizeAndColour) {
  Raster<Rgb8> picture = paper();
  const Rgb8 blue{10, 20, 90};
  fill(picture, 20, 20, 4, 9, blue);
  fill(picture, 40, 22, 3, 7, grey(30));
  auto pieces = pieces_of_ink(picture, {});
  ASSERT_EQ(pieces.size(), 2U);
  std::sort(pieces.begin(), pieces.end(), [](const Ink& a, const Ink& b) { return a.centre.x < b.centre.x; });
  EXPECT_NEAR(pieces[0].centre.x, 21.5, 1e-9);
  EXPECT_NEAR(pieces[0].centre.y, 24.0, 1e-9);
  EXPECT_EQ(pieces[0].size_px, 9.0);
  EXPECT_EQ(pieces[0].pixels.size(), 36U);
  EXPECT_NEAR(pieces[0].colour[0], 10.0, 1e-9);
  EXPECT_NEAR(pieces[0].colour[1], 20.0, 1e-9);
  EXPECT_NEAR(pieces[0].colour[2], 90.0, 1e-9);
  EXPECT_EQ(pieces[1].size_px, 7.0);
}

TEST(Ink, LeavesOutBordersFaintMarksAndSpecks) {
  Raster<Rgb8> picture = paper();
  fill(picture, 10, 10, 30, 1, grey(20));
  fill(picture, 60, 10, 3, 8, grey(kPaper - 70));
  fill(picture, 80, 10, 1, 1, grey(20));
  EXPECT_TRUE(pieces_of_ink(picture, {}).empty());
  TextLineOptions all;
  all.thin_line_length_px = 31.0;
  all.contrast = 60.0;
  all.smallest_letter_px = 1.0;
  EXPECT_EQ(pieces_of_ink(picture, all).size(), 3U);
}

TEST(Ink, GreyBetweenLettersSeparatesThem) {
  const auto pieces_with = [](int bridge) {
    Raster<Rgb8> picture = paper();
    fill(picture, 40, 20, 3, 10, grey(20));
    fill(picture, 43, 24, 2, 2, grey(kPaper - bridge));
    fill(picture, 45, 20, 3, 10, grey(20));
    return pieces_of_ink(picture, {}).size();
  };
  // The strongest contrast is 200 levels; ink has at least 0.55 of it.
  EXPECT_EQ(pieces_with(100), 2U);
  EXPECT_EQ(pieces_with(120), 1U);
}

}  // namespace
}  // namespace palpable::vision
