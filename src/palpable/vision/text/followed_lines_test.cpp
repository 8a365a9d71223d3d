// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/text/followed_lines.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr Rgb8 kNamesInk{60, 60, 60};
constexpr double kNamesHeight = 15.0;

class FollowedCanvas {
 public:
  void write(const std::string& text, cv::Point at, cv::Scalar colour = cv::Scalar(30, 30, 30)) {
    cv::putText(canvas_, text, at, cv::FONT_HERSHEY_DUPLEX, 0.5, colour, 1, cv::LINE_AA);
  }
  void border(cv::Point a, cv::Point b) { cv::line(canvas_, a, b, cv::Scalar(160, 107, 0), 2, cv::LINE_AA); }
  std::vector<TextLine> lines() const {
    Raster<Rgb8> picture(canvas_.cols, canvas_.rows);
    for (int y = 0; y < canvas_.rows; ++y)
      for (int x = 0; x < canvas_.cols; ++x) {
        const auto c = canvas_.at<cv::Vec3b>(y, x);
        picture(x, y) = {c[0], c[1], c[2]};
      }
    auto out = followed_lines(picture, kNamesHeight, kNamesInk, {});
    std::sort(out.begin(), out.end(),
              [](const TextLine& a, const TextLine& b) { return a.centre.front().y < b.centre.front().y; });
    return out;
  }

 private:
  cv::Mat canvas_{150, 300, CV_8UC3, cv::Scalar(250, 240, 220)};
};

TEST(FollowedLines, ABorderInAnotherColourThatTouchesLettersIsNoPartOfThem) {
  FollowedCanvas plain, touched;
  for (FollowedCanvas* canvas : {&plain, &touched}) canvas->write("Bangarten", {60, 80});
  touched.border({20, 84}, {280, 84});
  touched.border({61, 20}, {61, 140});
  const auto whole = plain.lines(), found = touched.lines();
  ASSERT_EQ(whole.size(), 1U);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].centre.front().x, whole[0].centre.front().x, 4.0);
  EXPECT_NEAR(static_cast<double>(found[0].centre.size()), static_cast<double>(whole[0].centre.size()), 5.0);
  EXPECT_NEAR(found[0].height_px, whole[0].height_px, 2.0);
}

TEST(FollowedLines, LinesCloseAboveEachOtherStayApart) {
  FollowedCanvas canvas;
  canvas.write("Tunnelstrasse", {60, 70});
  canvas.write("Palaisgarten", {60, 85});
  const auto found = canvas.lines();
  ASSERT_EQ(found.size(), 2U);
  for (const TextLine& line : found) EXPECT_LT(line.height_px, 1.2 * kNamesHeight);
}

TEST(FollowedLines, LetteringInAnotherColourIsLeftOut) {
  FollowedCanvas canvas;
  canvas.write("Novotel", {60, 80}, cv::Scalar(0, 140, 220));
  EXPECT_TRUE(canvas.lines().empty());
}

}  // namespace
}  // namespace palpable::vision
