// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/plane_rectification.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

constexpr int kLinesWidth = 400, kLinesHeight = 300;
const cv::Point2d kCentre(0.5 * (kLinesWidth - 1), 0.5 * (kLinesHeight - 1));

/// Nine lines of a plane, two pixels wide, that lead to a point.
void draw_lines_to(cv::Mat& canvas, cv::Point2d point) {
  const cv::Point2d to = point - kCentre, along = to / cv::norm(to), aside(-along.y, along.x);
  for (int k = -4; k <= 4; ++k) {
    const cv::Point2d middle = kCentre + 28.0 * k * aside;
    cv::Point2d direction = point - middle;
    direction /= cv::norm(direction);
    constexpr int kShift = 8;
    const auto fixed = [](cv::Point2d p) {
      return cv::Point(static_cast<int>(std::lround(p.x * (1 << kShift))),
                       static_cast<int>(std::lround(p.y * (1 << kShift))));
    };
    cv::line(canvas, fixed(middle - 110.0 * direction), fixed(middle + 110.0 * direction), cv::Scalar(40), 2,
             cv::LINE_AA, kShift);
  }
}

Image picture_of(const cv::Mat& canvas) {
  Image out{kLinesWidth, kLinesHeight, 1, 8, {}};
  for (int y = 0; y < kLinesHeight; ++y)
    for (int x = 0; x < kLinesWidth; ++x)
      out.samples.push_back(static_cast<float>(canvas.at<std::uint8_t>(y, x)) / 255.0F);
  return out;
}

/// Where two lines meet.
cv::Point2d meeting_of(const std::array<PictureLine, 2>& lines) {
  const auto line_of = [](const PictureLine& l) {
    return cv::Vec3d(l.from.x, l.from.y, 1.0).cross(cv::Vec3d(l.to.x, l.to.y, 1.0));
  };
  const cv::Vec3d p = line_of(lines[0]).cross(line_of(lines[1]));
  return {p[0] / p[2], p[1] / p[2]};
}

double direction_deg(cv::Point2d p) {
  return std::atan2(p.y - kCentre.y, p.x - kCentre.x) * 180.0 / std::numbers::pi;
}

TEST(PlaneLines, MeetInTheVanishingPointsOfAPlane) {
  const cv::Point2d right = kCentre + cv::Point2d(700.0, 80.0), up = kCentre + cv::Point2d(-60.0, -620.0);
  cv::Mat canvas(kLinesHeight, kLinesWidth, CV_8U, cv::Scalar(230));
  draw_lines_to(canvas, right);
  draw_lines_to(canvas, up);
  const auto lines = find_plane_lines(picture_of(canvas), Work{});
  ASSERT_TRUE(lines) << lines.error().sentence();
  const cv::Point2d along = meeting_of(lines->along), across = meeting_of(lines->across);
  EXPECT_NEAR(direction_deg(along), direction_deg(right), 1.0);
  EXPECT_NEAR(direction_deg(across), direction_deg(up), 1.0);
  EXPECT_NEAR(cv::norm(along - kCentre) / cv::norm(right - kCentre), 1.0, 0.1);
  EXPECT_NEAR(cv::norm(across - kCentre) / cv::norm(up - kCentre), 1.0, 0.1);
}

TEST(PlaneLines, NeedTwoDirections) {
  cv::Mat canvas(kLinesHeight, kLinesWidth, CV_8U, cv::Scalar(230));
  draw_lines_to(canvas, kCentre + cv::Point2d(700.0, 80.0));
  const auto lines = find_plane_lines(picture_of(canvas), Work{});
  ASSERT_FALSE(lines);
  EXPECT_EQ(lines.error().reason, Reason::needs_plane_marks);
}

}  // namespace
}  // namespace palpable::vision
