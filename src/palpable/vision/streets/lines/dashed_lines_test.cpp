// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/streets/lines/dashed_lines.hpp"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr int kLandSide = 200;
constexpr double kSlope = 0.3, kAt = 60.0;

/// A map of land on which lines are drawn with fractions of pixels, as maps are.
class Land {
 public:
  Land() : canvas_(kLandSide, kLandSide, CV_8UC3, cv::Scalar(242, 239, 233)) {}

  void line(double x0, double y0, double x1, double y1, Rgb8 colour, int width = 1) {
    constexpr int kBits = 4;
    constexpr double kOne = 1 << kBits;
    cv::line(canvas_, {cvRound(x0 * kOne), cvRound(y0 * kOne)}, {cvRound(x1 * kOne), cvRound(y1 * kOne)},
             cv::Scalar(colour.r, colour.g, colour.b), width, cv::LINE_AA, kBits);
  }
  /// Dashes from 10 to 190 px along y = `at` + kSlope x.
  void dashes(double at, double length, double gap, Rgb8 colour) {
    for (double x = 10.0; x + length <= 190.0; x += length + gap)
      line(x, at + kSlope * x, x + length, at + kSlope * (x + length), colour);
  }
  CentreLines found(std::vector<Rgb8> of_other = {}) const {
    Raster<Rgb8> picture(kLandSide, kLandSide);
    for (int y = 0; y < kLandSide; ++y)
      for (int x = 0; x < kLandSide; ++x) {
        const auto c = canvas_.at<cv::Vec3b>(y, x);
        picture(x, y) = {c[0], c[1], c[2]};
      }
    return dashed_lines(picture, Raster<std::uint8_t>(kLandSide, kLandSide), of_other);
  }

 private:
  cv::Mat canvas_;
};

constexpr Rgb8 kTrack{153, 102, 0}, kCycleway{0, 0, 255};

TEST(DashedLines, FollowARowOfDashes) {
  Land land;
  land.dashes(kAt, 5.0, 4.0, kTrack);
  const CentreLines found = land.found();
  ASSERT_EQ(found.lines.size(), 1U);
  EXPECT_EQ(found.lines[0].kind, MapStreet::Kind::path);
  EXPECT_NEAR(length_px(found.lines[0].points), 180.0 * std::hypot(1.0, kSlope), 12.0);
  for (const MapPoint p : found.lines[0].points) EXPECT_NEAR(p.y, kAt + kSlope * p.x, 1.5);
}

TEST(DashedLines, OfTwoColoursStayApart) {
  Land land;
  land.dashes(kAt, 5.0, 4.0, kTrack);
  land.dashes(kAt + 7.0, 2.0, 3.0, kCycleway);
  EXPECT_EQ(land.found().lines.size(), 2U);
}

TEST(DashedLines, AreNoThinLinesWithoutGaps) {
  Land land;
  land.line(10, kAt, 190, kAt + kSlope * 180.0, {150, 150, 150});
  EXPECT_TRUE(land.found().lines.empty());
}

TEST(DashedLines, AreNoEdgesOfAreas) {
  Land land;
  // A tunnel: a pale fill between dashed casings.
  land.line(0, kAt + 4.0, 199, kAt + 4.0 + kSlope * 199.0, {253, 231, 203}, 9);
  land.dashes(kAt, 4.0, 3.0, kTrack);
  land.dashes(kAt + 9.0, 4.0, 3.0, kTrack);
  EXPECT_TRUE(land.found().lines.empty());
}

TEST(DashedLines, InTheColourOfWaterAreStreamsInPipes) {
  Land land;
  land.dashes(kAt, 5.0, 4.0, {170, 211, 223});
  EXPECT_EQ(land.found().lines.size(), 1U);
  EXPECT_TRUE(land.found({{170, 211, 223}}).lines.empty());
}

}  // namespace
}  // namespace palpable::vision
