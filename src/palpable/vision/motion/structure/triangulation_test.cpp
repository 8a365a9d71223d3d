// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/triangulation.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

std::vector<PosedObservation> views_of(Vec3 point, std::vector<double> angles) {
  std::vector<PosedObservation> out;
  for (const double angle : angles) {
    const CameraPose pose = facing_origin(angle);
    out.push_back({bundle_pose(pose), seen_from(pose, point)});
  }
  return out;
}

TEST(Triangulation, IsExactForExactObservations) {
  for (const Vec3& point : points_around_origin(20)) {
    const auto found = triangulated_point(views_of(point, {0.0, 0.1, 0.3}), kExactCamera, {});
    ASSERT_TRUE(found);
    EXPECT_NEAR(norm(Vec3{(*found)[0], (*found)[1], (*found)[2]} - point), 0.0, 1e-9);
  }
}

TEST(Triangulation, NeedsTheAngleBetweenTheRays) {
  // Seen from the origin's side, cameras at angles a and b see the origin along rays a - b apart.
  const double two_deg = 0.0349065850;
  EXPECT_TRUE(triangulated_point(views_of({}, {0.0, two_deg}), kExactCamera, {.least_angle_deg = 1.9}));
  EXPECT_FALSE(triangulated_point(views_of({}, {0.0, two_deg}), kExactCamera, {.least_angle_deg = 2.1}));
  EXPECT_FALSE(triangulated_point(views_of({}, {0.0}), kExactCamera, {}));
}

TEST(Triangulation, RefusesAnObservationThatDoesNotFit) {
  auto views = views_of({0.1, 0.0, 0.0}, {0.0, 0.2, 0.4});
  // Across the plane of the rays no place of the point explains it.
  views[1].place.y += 12.0;
  EXPECT_FALSE(triangulated_point(views, kExactCamera, {.outlier_px = 2.0}));
  EXPECT_TRUE(triangulated_point(views, kExactCamera, {.outlier_px = 20.0}));
}

TEST(Triangulation, RefusesAPointBehindTheCameras) {
  // Both cameras look along +z, and the rays part: their lines meet at z = -1.
  BundlePose right{};
  right[3] = -0.2;
  const std::vector<PosedObservation> parting{{BundlePose{}, {319.5 - 50, 239.5}},
                                              {right, {319.5 + 50, 239.5}}};
  EXPECT_FALSE(triangulated_point(parting, kExactCamera, {}));
}

}  // namespace
}  // namespace palpable::vision
