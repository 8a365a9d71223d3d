// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/rectification/any_motion.hpp"

#include "palpable/vision/rectification/seen_points.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

std::optional<PairMotion> motion_of(const std::vector<SeenPoint>& points) {
  return find_any_motion(matches_of(points), unknown_camera(kSeenWidth, kSeenHeight), 1.5);
}

/// The greatest over the least of disparity times depth in the frame, of the points' 5 % to 95 % quantiles,
/// negative if there are negative disparities; 0 without a frame.
double spread_of(const std::vector<SeenPoint>& points) {
  const auto motion = motion_of(points);
  if (!motion) return 0.0;
  EXPECT_TRUE(has_parallax(*motion));
  EXPECT_FALSE(keeps_pictures(*motion, kSeenWidth, kSeenHeight));
  EXPECT_GT(motion->inliers.size(), 270U);
  const EpipolarFrame frame = frame_of_motion(*motion, kSeenWidth, kSeenHeight).frame;
  std::vector<double> products;
  double off_rows = 0.0;
  for (const auto& [m, depth_m] : points) {
    const PicturePoint left = frame_from_picture(frame, frame.transform.left, {m.left_x, m.left_y}),
                       right = frame_from_picture(frame, frame.transform.right, {m.right_x, m.right_y});
    products.push_back(disparity_from_columns(frame, {m.left_x, m.left_y}, left.x - right.x) * depth_m);
    if (!frame.polar) off_rows = std::max(off_rows, std::abs(left.y - right.y));
  }
  EXPECT_LT(off_rows, 1.5);
  std::sort(products.begin(), products.end());
  return products[products.size() * 95 / 100] / products[products.size() * 5 / 100];
}

TEST(AnyMotion, GivesInverseDepthsForACameraThatMovedUpOrDownOrObliquely) {
  for (const cv::Vec3d& move : {cv::Vec3d(0, -0.12, 0), cv::Vec3d(-0.1, 0.06, 0)})
    for (const cv::Vec3d& turn : {cv::Vec3d(0, 0, 0), cv::Vec3d(2, 3, 10)}) {
      const double spread = spread_of(seen_points(move, turn));
      EXPECT_GT(spread, 1.0) << move << turn;
      EXPECT_LT(spread, 1.3) << move << turn;
    }
}

TEST(AnyMotion, GivesInverseDepthsAlongTheLeftPicturesAxisForAMotionOffTheSide) {
  const double spread = spread_of(seen_points({0.12, 0.0, 0.03}, {1, -1, 1}));
  EXPECT_GT(spread, 1.0);
  EXPECT_LT(spread, 1.3);
}

TEST(AnyMotion, UndoesAZoom) {
  const double spread = spread_of(seen_points({0.12, 0.0, 0.0}, {0, 1, 0}, 1.08));
  EXPECT_GT(spread, 1.0);
  EXPECT_LT(spread, 1.3);
}

TEST(AnyMotion, GivesDepthsForACameraThatMovedForwardOrBackward) {
  for (const cv::Vec3d& move : {cv::Vec3d(0, 0, 0.4), cv::Vec3d(0.05, 0, -0.4), cv::Vec3d(0.3, 0, 0.3)}) {
    const double spread = spread_of(seen_points(move, {2, -1, 3}));
    EXPECT_GT(spread, 1.0) << move;
    EXPECT_LT(spread, 1.5) << move;
  }
}

TEST(AnyMotion, LeavesASidewaysCameraToTheRectifyingRotations) {
  const auto motion = motion_of(seen_points({0.12, 0.0, 0.0}, {0, 0, 0.3}, 1.0, 0.7, 2.0));
  ASSERT_TRUE(motion);
  EXPECT_TRUE(keeps_pictures(*motion, kSeenWidth, kSeenHeight));
}

TEST(AnyMotion, SeesNoParallaxWhereTheCameraOnlyTurnedOrZoomed) {
  for (const double zoom : {1.0, 0.92, 1.1}) {
    const auto motion = motion_of(seen_points({0, 0, 0}, {2, 5, 8}, zoom));
    EXPECT_TRUE(!motion || !has_parallax(*motion)) << zoom;
  }
}

TEST(AnyMotion, IsNotClearByFewPointsOrAmongManyOthers) {
  auto points = seen_points({0.12, 0.02, 0.0}, {2, 3, 1});
  const auto motion = motion_of(points);
  ASSERT_TRUE(motion);
  EXPECT_TRUE(is_clear(*motion, points.size(), 1.5));
  EXPECT_FALSE(is_clear(*motion, 2 * points.size(), 1.5));
  EXPECT_FALSE(is_clear(*motion, points.size(), 0.5));
  points.resize(100);
  const auto of_few = motion_of(points);
  EXPECT_TRUE(!of_few || !is_clear(*of_few, points.size(), 1.5));
}

TEST(AnyMotion, KeepsItsParallaxFromASurfaceOfOffsets) {
  const auto points = seen_points({0, 0.02, 0.3}, {1, 0, 1});
  const auto motion = motion_of(points);
  ASSERT_TRUE(motion);
  const auto offsets = VerticalOffsets::through(matches_of(points), kSeenWidth, kSeenHeight);
  ASSERT_TRUE(offsets);
  EXPECT_FALSE(offsets_explain_more(*offsets, *motion, matches_of(points), 1.5));
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
    EXPECT_NEAR(
        columns_from_disparity(frame, {310.0, 40.0}, disparity_from_columns(frame, {310.0, 40.0}, 17.0)),
        17.0, 1e-9);
    // A point at twice the radius after a movement forward by half its distance.
    const double disparity_px = 0.5 * 140.0;
    const PicturePoint right = right_point(frame, {210.0, 150.0}, forward ? disparity_px : 140.0);
    EXPECT_NEAR(right.x, forward ? 220.0 : 205.0, 1e-9);
    EXPECT_NEAR(right.y, 150.0, 1e-9);
  }
}

}  // namespace
}  // namespace palpable::vision
