// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/any_motion.hpp"

#include "palpable/vision/rectification/rectifying_rotations.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <opencv2/calib3d.hpp>

namespace palpable::vision {
namespace {

constexpr int kWidth = 480, kHeight = 360;
constexpr double kFocal_px = 400.0;

struct SeenPoint {
  FeatureMatch match;
  double depth_m;
};

/// Points 1.5 to 4 m away, seen before and after the camera moved by `move_m` and turned by `turn_deg`.
std::vector<SeenPoint> seen_points(cv::Vec3d move_m, cv::Vec3d turn_deg, double zoom = 1.0) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> across(0.0, kWidth - 1.0), down(0.0, kHeight - 1.0), depth(1.5, 4.0);
  std::normal_distribution<double> error(0.0, 0.2);
  const double cx = 0.5 * (kWidth - 1), cy = 0.5 * (kHeight - 1);
  cv::Matx33d left_from_right;
  cv::Rodrigues(turn_deg * (CV_PI / 180.0), left_from_right);
  std::vector<SeenPoint> out;
  for (int i = 0; i < 300; ++i) {
    const double x = across(random), y = down(random), z = depth(random);
    const cv::Vec3d point((x - cx) / kFocal_px * z, (y - cy) / kFocal_px * z, z);
    const cv::Vec3d p = left_from_right.t() * (point - move_m);
    const double u = cx + zoom * kFocal_px * p[0] / p[2], v = cy + zoom * kFocal_px * p[1] / p[2];
    out.push_back({{x, y, u + error(random), v + error(random)}, z});
  }
  return out;
}

std::vector<FeatureMatch> matches_of(const std::vector<SeenPoint>& points) {
  std::vector<FeatureMatch> out;
  for (const SeenPoint& p : points) out.push_back(p.match);
  return out;
}

/// The greatest over the least of disparity times depth in the frame, of the points' 5 % to 95 % quantiles,
/// negative if there are negative disparities; 0 without a frame.
double spread_of(const std::vector<SeenPoint>& points) {
  const auto matches = matches_of(points);
  const auto motion = find_any_motion(matches, kWidth, kHeight, 1.5);
  if (!motion) return 0.0;
  EXPECT_FALSE(is_sideways(*motion));
  const auto found = frame_of_motion(*motion, matches, kWidth, kHeight, 1.5, 1);
  if (!found) return 0.0;
  EXPECT_LT(found->residual_px, 0.5);
  EXPECT_GT(found->inliers.size(), 270U);
  std::vector<double> products;
  const EpipolarFrame& frame = found->frame;
  for (const auto& [m, depth_m] : points) {
    const PicturePoint left = frame_from_picture(frame, frame.transform.left, {m.left_x, m.left_y}),
                       right = frame_from_picture(frame, frame.transform.right, {m.right_x, m.right_y});
    products.push_back(disparity_from_columns(frame, left.x - right.x) * depth_m);
  }
  std::sort(products.begin(), products.end());
  return products[products.size() * 95 / 100] / products[products.size() * 5 / 100];
}

// Without a turn of the camera, which would add a constant to all disparities.
TEST(AnyMotion, FindsCommonRowsForACameraThatMovedUpOrDownOrObliquely) {
  for (const cv::Vec3d& move : {cv::Vec3d(0, -0.12, 0), cv::Vec3d(-0.1, 0.06, 0)}) {
    const double spread = spread_of(seen_points(move, {0, 0, 0}));
    EXPECT_GT(spread, 1.0) << move;
    EXPECT_LT(spread, 1.3) << move;
  }
}

TEST(AnyMotion, GivesDepthsForACameraThatMovedForwardOrBackward) {
  for (const cv::Vec3d& move : {cv::Vec3d(0, 0, 0.4), cv::Vec3d(0.05, 0, -0.4), cv::Vec3d(0.3, 0, 0.3)}) {
    const double spread = spread_of(seen_points(move, {2, -1, 3}));
    EXPECT_GT(spread, 1.0) << move;
    EXPECT_LT(spread, 1.5) << move;
  }
}

TEST(AnyMotion, LeavesASidewaysCameraToTheRectifyingRotations) {
  const auto motion =
      find_any_motion(matches_of(seen_points({0.12, 0.005, 0.0}, {1, 1, 2})), kWidth, kHeight, 1.5);
  ASSERT_TRUE(motion);
  EXPECT_TRUE(is_sideways(*motion));
}

TEST(AnyMotion, SeesNoMotionWhereTheCameraOnlyTurned) {
  EXPECT_FALSE(find_any_motion(matches_of(seen_points({0, 0, 0}, {2, 5, 8})), kWidth, kHeight, 1.5));
}

TEST(EpipolarFrame, ReturnsTheSamePointAndTheSameDisparity) {
  EpipolarFrame frame;
  frame.width = 500;
  frame.height = 900;
  for (const bool forward : {true, false}) {
    frame.polar = PolarAxes{{200.0, 150.0}, 140.0, -3.0, forward ? 300.0 : 5.0, forward};
    const PicturePoint there = frame_from_picture(frame, frame.transform.left, {310.0, 40.0});
    const PicturePoint back = picture_from_frame(frame, inverse(frame.transform.left), there);
    EXPECT_NEAR(back.x, 310.0, 1e-9);
    EXPECT_NEAR(back.y, 40.0, 1e-9);
    EXPECT_NEAR(columns_from_disparity(frame, disparity_from_columns(frame, 17.0)), 17.0, 1e-9);
    // A point at twice the radius after a movement forward by half its distance.
    const double disparity_px = 0.5 * 140.0;
    const PicturePoint right = right_point(frame, {210.0, 150.0}, forward ? disparity_px : 140.0);
    EXPECT_NEAR(right.x, forward ? 220.0 : 205.0, 1e-9);
    EXPECT_NEAR(right.y, 150.0, 1e-9);
  }
}

TEST(KeepsPicture, IsTrueOfSmallRollsAndShifts) {
  const auto turned = [](double degrees, double right_px) {
    const double c = std::cos(degrees * CV_PI / 180.0), s = std::sin(degrees * CV_PI / 180.0);
    const double cx = 0.5 * (kWidth - 1), cy = 0.5 * (kHeight - 1);
    return Matrix3{c, -s, cx - c * cx + s * cy + right_px, s, c, cy - s * cx - c * cy, 0, 0, 1};
  };
  EXPECT_TRUE(keeps_picture(turned(0, 0), kWidth, kHeight));
  EXPECT_TRUE(keeps_picture(turned(-4, 0), kWidth, kHeight));
  EXPECT_TRUE(keeps_picture(turned(0, 0.15 * kWidth), kWidth, kHeight));
  EXPECT_FALSE(keeps_picture(turned(6, 0), kWidth, kHeight));
  EXPECT_FALSE(keeps_picture(turned(-20, 0), kWidth, kHeight));
  EXPECT_FALSE(keeps_picture(turned(0, -0.3 * kWidth), kWidth, kHeight));
}

}  // namespace
}  // namespace palpable::vision
