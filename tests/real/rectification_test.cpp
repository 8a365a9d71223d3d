// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/depth_file.hpp"
#include "palpable/sources/picture/picture.hpp"
#include "palpable/vision/image/opencv_image.hpp"
#include "palpable/vision/rectification/chessboard_calibration.hpp"
#include "palpable/vision/rectification/stereo_rectification.hpp"
#include "palpable/vision/stereo/methods/match.hpp"
#include "palpable/vision/stereo/problem/epipolar_pictures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

class RealPairs : public testing::Test {
 protected:
  void SetUp() override {
    const char* data = std::getenv("PALPABLE_DATA");
    if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
    stereo_ = std::string(data) + "/stereo/";
  }
  StereoPair read(const std::string& left, const std::string& right) const {
    auto l = sources::read_picture(stereo_ + left), r = sources::read_picture(stereo_ + right);
    EXPECT_TRUE(l && r) << left;
    return {*std::move(l), *std::move(r), {}};
  }
  StereoPair chessboard(int i) const {
    const std::string number = (i < 10 ? "0" : "") + std::to_string(i) + ".jpg";
    return read("calib_chessboard/left" + number, "calib_chessboard/right" + number);
  }
  static constexpr std::array kChessboards{1, 2, 3, 4, 5, 6, 7, 8, 9, 11, 12, 13, 14};
  std::string stereo_;
};

std::vector<cv::Point2f> corners_of(const Image& picture) {
  std::vector<cv::Point2f> corners;
  const cv::Mat grey = grey8_of(picture);
  if (!cv::findChessboardCorners(grey, {9, 6}, corners)) return {};
  cv::cornerSubPix(grey, corners, {5, 5}, {-1, -1},
                   {cv::TermCriteria::EPS | cv::TermCriteria::COUNT, 40, 0.001});
  return corners;
}

/// RMS of y_left - y_right over the board's corners, which are not used by the rectification; NaN unless both
/// pictures show the whole board.
double corner_rms_px(const StereoPair& pair) {
  const auto left = corners_of(pair.left), right = corners_of(pair.right);
  if (left.empty() || right.empty()) return std::nan("");
  double squares = 0.0;
  for (std::size_t i = 0; i < left.size(); ++i) squares += std::pow(left[i].y - right[i].y, 2);
  return std::sqrt(squares / static_cast<double>(left.size()));
}

/// The pictures on common rows.
StereoPair on_rows(const RectifiedPair& rectified) {
  return rectified.pair.frame ? in_epipolar_frame(rectified.pair) : rectified.pair;
}

TEST_F(RealPairs, ChessboardsOfUnknownCamerasShareScanlines) {
  // A chessboard is periodic: feature matching fails on it, tracked corners do not. In pair 12 the first good
  // match is one period off. In pair 5 a wrong rotation explains more features than the true one.
  for (const int i : {5, 12}) {
    const auto rectified = rectify_uncalibrated(chessboard(i), {});
    ASSERT_TRUE(rectified);
    EXPECT_GT(rectified->residual_before_px, 8.0) << i;
    EXPECT_LE(rectified->residual_px, 0.5) << i;
    EXPECT_LE(corner_rms_px(on_rows(*rectified)), 0.5) << i;
  }
}

TEST_F(RealPairs, ChessboardsOfCalibratedCamerasShareScanlines) {
  std::vector<StereoPair> pairs;
  for (const int i : kChessboards) pairs.push_back(chessboard(i));
  const auto calibration = calibrate_from_chessboards(pairs, {}, {});
  ASSERT_TRUE(calibration);
  EXPECT_EQ(calibration->pairs_used, 13);
  EXPECT_LE(calibration->reprojection_px, 0.3);
  for (std::size_t i = 0; i < pairs.size(); i += 3) {
    const auto rectified = rectify_calibrated(pairs[i], calibration->cameras);
    ASSERT_TRUE(rectified);
    EXPECT_LE(corner_rms_px(rectified->pair), 0.5) << i;
  }
}

/// The picture of a camera rotated by these angles.
Image turned(const Image& picture, double f, double about_x_deg, double about_y_deg, double about_z_deg) {
  const double degree = std::numbers::pi / 180.0;
  cv::Matx33d r;
  cv::Rodrigues(cv::Vec3d(about_x_deg, about_y_deg, about_z_deg) * degree, r);
  const cv::Matx33d k(f, 0, 0.5 * (picture.width - 1), 0, f, 0.5 * (picture.height - 1), 0, 0, 1);
  cv::Mat out;
  cv::warpPerspective(view_of(picture), out, k * r * k.inv(), {picture.width, picture.height},
                      cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return image_from(out, picture);
}

TEST_F(RealPairs, RotatedByUpToFiveDegreesShareScanlinesAgain) {
  const std::array<std::array<std::string, 2>, 2> files{
      {{"mid2_tsukuba/imL.png", "mid2_tsukuba/imR.png"},
       {"mid14_Motorcycle/motorcycle_left.png", "mid14_Motorcycle/motorcycle_right.png"}}};
  for (const auto& [left, right] : files) {
    const StereoPair straight = read(left, right);
    for (const auto& [x, y, z] : std::vector<std::array<double, 3>>{{0, 5, 0}, {-3, 3, 3}}) {
      const StereoPair pair{straight.left, turned(straight.right, straight.right.width, x, y, z), {}};
      const auto rectified = rectify_uncalibrated(pair, {});
      ASSERT_TRUE(rectified);
      EXPECT_TRUE(rectified->changed) << left;
      EXPECT_LE(rectified->residual_px, 0.5) << left;
      // Features of the rectified pictures confirm the result.
      const auto again = rectify_uncalibrated(on_rows(*rectified), {});
      ASSERT_TRUE(again);
      EXPECT_FALSE(again->changed) << left;
      EXPECT_LE(again->residual_before_px, 0.5) << left;
    }
  }
}

TEST_F(RealPairs, AMovedCameraGivesMetricDepth) {
  constexpr double kFocal_px = 820.0, kMoved_m = 0.06;
  const StereoPair straight = read("rendered_heads/left.png", "rendered_heads/right.png");
  const auto truth = sources::read_disparity(stereo_ + "rendered_heads/disp_left.pfm", 1.0,
                                             sources::UnknownDisparity::not_finite);
  ASSERT_TRUE(truth);
  const Raster<float>& truth_px = truth->disparity.disparity_px;
  const StereoPair pair{straight.left, turned(straight.right, kFocal_px, 0.5, -0.7, 0.6), {}};
  const auto rectified =
      rectify_moved_camera(pair, {{kFocal_px, 0, 359.5, 0, kFocal_px, 239.5, 0, 0, 1}, {}}, kMoved_m, {});
  ASSERT_TRUE(rectified && rectified->pair.rig);
  const auto found = match(rectified->pair, StereoMethod::fast, {}, {});
  ASSERT_TRUE(found);
  const StereoRig& rig = *rectified->pair.rig;
  std::vector<double> errors;
  for (int y = 0; y < truth_px.height(); y += 3)
    for (int x = 0; x < truth_px.width(); x += 3) {
      const auto metres = [&](float d) {
        return rig.baseline_m * rig.left.fx / (static_cast<double>(d) + rig.doffs_px);
      };
      const double real_m = kMoved_m * kFocal_px / static_cast<double>(truth_px(x, y));
      errors.push_back(std::abs(metres(found->disparity.disparity_px(x, y)) / real_m - 1.0));
    }
  std::nth_element(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2),
                   errors.end());
  EXPECT_LT(errors[errors.size() / 2], 0.02);
}

}  // namespace
}  // namespace palpable::vision
