// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// A ball of 10 mm round the origin, seen from 0.2 m before it on the z axis, or behind it.
DepthMap ball_seen(double focal_px) {
  constexpr int kSide = 81;
  constexpr double kAway = 0.2;
  DepthMap map{Raster<float>(kSide, kSide, std::numeric_limits<float>::infinity()),
               Pinhole{focal_px, focal_px, 40.0, 40.0, kSide, kSide}};
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vec3 along = unit({(x - 40) / focal_px, (y - 40) / focal_px, 1.0});
      const double half = kAway * along.z;
      const double under = half * half - kAway * kAway + 1e-4;
      map.depth_m(x, y) = under > 0.0 ? static_cast<float>((half - std::sqrt(under)) * along.z) : 1.0F;
    }
  return map;
}

const Transform<SceneFrame, CameraFrame> kFront{{1, 0, 0, 0, -1, 0, 0, 0, -1}, {0, 0, 0.2}, 1.0};
const Transform<SceneFrame, CameraFrame> kBack{{-1, 0, 0, 0, -1, 0, 0, 0, 1}, {0, 0, -0.2}, 1.0};

std::size_t count_of(const models::Occupancy& o) {
  std::size_t count = 0;
  for (const auto on : o.occupied) count += on;
  return count;
}

TEST(OccupancyFromDepth, FillsAwayFromTheCameraAndCarvesWithMoreViews) {
  const DepthMap map = ball_seen(600.0);
  const VolumeBox box{{-0.015, -0.015, -0.015}, {0.015, 0.015, 0.015}, 0.0};
  const std::vector<DepthView> one{{&map, kFront}};
  const std::vector<DepthView> both{{&map, kFront}, {&map, kBack}};
  const auto filled = occupancy_from_depth(one, box, {60}, Work{});
  const auto carved = occupancy_from_depth(both, box, {60}, Work{});
  ASSERT_TRUE(filled && carved);
  // Two opposite views leave the ball, and the part behind each view's horizon.
  const double points = 4.0 / 3.0 * 3.14159265 * 20.0 * 20.0 * 20.0;
  EXPECT_NEAR(static_cast<double>(count_of(*carved)), points, 0.06 * points);
  EXPECT_GT(count_of(*filled), 1.2 * points);
  const auto grid = models::OccupancyGrid::from(*carved, Work{});
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(grid->sample({{0.0, 0.0, 0.008}}).depth_m, 0.002, 0.0006);
  EXPECT_GT(grid->sample({{0.0, 0.0, 0.008}}).normal.v.z, 0.9);
}

TEST(OccupancyFromDepth, FillsUnderARelief) {
  Raster<float> heights(41, 41, 0.004F);
  auto relief = models::Relief::from_samples(std::move(heights), 0.001);
  ASSERT_TRUE(relief.has_value());
  const auto o = occupancy_from_relief(*relief, {82});
  ASSERT_TRUE(o.has_value());
  const auto grid = models::OccupancyGrid::from(*o, Work{});
  ASSERT_TRUE(grid.has_value());
  EXPECT_NEAR(grid->sample({{0.001, 0.002, 0.003}}).depth_m, 0.001, 0.0005);
  EXPECT_GT(grid->sample({{0.001, 0.002, 0.003}}).normal.v.z, 0.99);
  EXPECT_LT(grid->sample({{0.001, 0.002, 0.005}}).depth_m, 0.0);
}

TEST(OccupancyFromDepth, RefusesInvalidBoxesAndMaps) {
  DepthMap blind = ball_seen(600.0);
  const VolumeBox box{{-0.015, -0.015, -0.015}, {0.015, 0.015, 0.015}, 0.0};
  const std::vector<DepthView> views{{&blind, kFront}};
  EXPECT_FALSE(occupancy_from_depth(views, box, {4}, Work{}));
  EXPECT_FALSE(occupancy_from_depth(views, {box.most_m, box.least_m, 0.0}, {60}, Work{}));
  blind.camera.reset();
  EXPECT_FALSE(occupancy_from_depth(views, box, {60}, Work{}));
}

}  // namespace
}  // namespace palpable::sculpt
