// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/motion_filter.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

double depth_in(const CameraPose& pose, Vec3 point) {
  return (pose.inverse() * Point<WorldFrame>{point}).v.z;
}

std::vector<TrackPlace> places_from(const CameraPose& pose, const std::vector<Vec3>& points) {
  std::vector<TrackPlace> out;
  for (std::size_t i = 0; i < points.size(); ++i) out.push_back({i, seen_from(pose, points[i])});
  return out;
}

/// A filter at the first pose that knows the points: `wrong` is the factor of their inverse depths.
void begin(MotionFilter& filter, const std::vector<Vec3>& points, double wrong) {
  const CameraPose first = facing_origin(0.0);
  filter.set_pose(bundle_pose(first));
  for (std::size_t i = 0; i < points.size(); ++i)
    filter.add_point({i, seen_from(first, points[i])},
                     (i % 2 == 0 ? wrong : 1.0 / wrong) / depth_in(first, points[i]), 0.3);
  filter.fix_scale();
}

TEST(MotionFilter, PutsAPointOnItsLineOfSightAtItsDepth) {
  const auto points = points_around_origin(20);
  MotionFilter filter({kExactCamera, true}, {});
  begin(filter, points, 1.0);
  for (const FilteredPoint& point : filter.points())
    EXPECT_NEAR(norm(point.world - points[point.track]), 0.0, 1e-9);
  const BundlePose pose = filter.pose(), truth = bundle_pose(facing_origin(0.0));
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(pose[i], truth[i], 1e-12);
}

TEST(MotionFilter, FollowsTheCameraAndLearnsTheDepths) {
  const auto points = points_around_origin(40);
  MotionFilter filter({kExactCamera, true}, {});
  begin(filter, points, 1.1);
  for (int k = 1; k <= 20; ++k) {
    filter.predict(1);
    EXPECT_GT(filter.update(places_from(facing_origin(0.02 * k), points)), 30) << k;
  }
  const CameraPose found = camera_pose(filter.pose()), truth = facing_origin(0.4);
  EXPECT_NEAR(found.rotation[0], truth.rotation[0], 0.01);
  EXPECT_NEAR(found.rotation[2], truth.rotation[2], 0.01);
  // Up to the scale, which the mean of the first inverse depths gives.
  EXPECT_NEAR(norm(unit(found.translation_m) - unit(truth.translation_m)), 0.0, 0.02);
  const Vec3 a = filter.points()[0].world - filter.points()[2].world;
  const Vec3 b = filter.points()[1].world - filter.points()[3].world;
  EXPECT_NEAR(norm(a) / norm(b), norm(points[0] - points[2]) / norm(points[1] - points[3]), 0.02);
}

TEST(MotionFilter, ForgetsRemovedPoints) {
  const auto points = points_around_origin(20);
  MotionFilter filter({kExactCamera, true}, {});
  begin(filter, points, 1.0);
  filter.remove_point(3);
  const auto left = filter.points();
  ASSERT_EQ(left.size(), 19U);
  for (const FilteredPoint& point : left) {
    EXPECT_NE(point.track, 3U);
    EXPECT_NEAR(norm(point.world - points[point.track]), 0.0, 1e-9);
  }
}

TEST(MotionFilter, ChangesNothingWithTooFewPlaces) {
  const auto points = points_around_origin(20);
  FilterMotionOptions options;
  options.least_points = 15;
  MotionFilter filter({kExactCamera, true}, options);
  begin(filter, points, 1.0);
  const BundlePose before = filter.pose();
  auto few = places_from(facing_origin(0.05), points);
  few.resize(14);
  EXPECT_EQ(filter.update(few), 0);
  EXPECT_EQ(filter.pose(), before);
}

}  // namespace
}  // namespace palpable::vision
