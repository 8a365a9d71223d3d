// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/line_extension.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr int kSide = 300;

Raster<Rgb8> raster_of(const cv::Mat& canvas) {
  Raster<Rgb8> out(canvas.cols, canvas.rows);
  for (int y = 0; y < canvas.rows; ++y)
    for (int x = 0; x < canvas.cols; ++x) {
      const auto c = canvas.at<cv::Vec3b>(y, x);
      out(x, y) = {c[0], c[1], c[2]};
    }
  return out;
}

cv::Mat words(const std::string& text) {
  cv::Mat canvas(kSide, kSide, CV_8UC3, cv::Scalar(225, 225, 225));
  cv::putText(canvas, text, {80, 150}, cv::FONT_HERSHEY_DUPLEX, 0.6, cv::Scalar(30, 30, 30), 1, cv::LINE_AA);
  return canvas;
}

double left_end(const TextLine& line) { return std::min(line.centre.front().x, line.centre.back().x); }
double right_end(const TextLine& line) { return std::max(line.centre.front().x, line.centre.back().x); }

TEST(LineExtension, FindsAFirstLetterThatTouchesABorder) {
  const auto whole = find_text_lines(raster_of(words("Bangarten")));
  ASSERT_EQ(whole.size(), 1U);
  // The border goes through the left side of the B, which is no letter by its size any more.
  cv::Mat canvas = words("Bangarten");
  cv::line(canvas, {82, 80}, {82, 220}, cv::Scalar(30, 30, 30), 1);
  const Raster<Rgb8> picture = raster_of(canvas);
  const auto found = find_text_lines(picture);
  ASSERT_EQ(found.size(), 1U);
  ASSERT_GT(left_end(found[0]), left_end(whole[0]) + 6.0);
  const auto longer = extended_lines(picture, found, TextLineOptions{}.thickest_stroke_px);
  ASSERT_EQ(longer.size(), 1U);
  EXPECT_LT(left_end(longer[0]), left_end(whole[0]) + 4.0);
  EXPECT_GT(left_end(longer[0]), left_end(whole[0]) - 3.0) << "the border is no lettering";
  EXPECT_NEAR(right_end(longer[0]), right_end(whole[0]), 1.0);
}

TEST(LineExtension, LeavesOutLinesThatEndInFreeSpaceAndBordersAlongThem) {
  const auto whole = find_text_lines(raster_of(words("Bangarten")));
  ASSERT_EQ(whole.size(), 1U);
  EXPECT_TRUE(extended_lines(raster_of(words("Bangarten")), whole, 7).empty());
  // A dark line that goes on from the last letter to the picture's side is no lettering.
  cv::Mat canvas = words("Bangarten");
  const int end = static_cast<int>(right_end(whole[0]));
  cv::line(canvas, {end + 3, 145}, {kSide - 1, 145}, cv::Scalar(30, 30, 30), 1);
  EXPECT_TRUE(extended_lines(raster_of(canvas), whole, 7).empty());
}

}  // namespace
}  // namespace palpable::vision
