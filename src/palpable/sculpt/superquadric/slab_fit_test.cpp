// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/slab_fit.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// 400 points in steps of 1 mm on the plane z = x / 10.
std::vector<Vec3> slope() {
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) {
    const double x = 0.001 * (i % 20), y = 0.001 * (i / 20);
    points.push_back({x, y, 0.1 * x});
  }
  return points;
}

TEST(PlaneThrough, IsTheLeastSquaresPlane) {
  const Plane plane = plane_through(slope());
  EXPECT_NEAR(std::abs(dot(plane.normal, unit({-0.1, 0.0, 1.0}))), 1.0, 1e-12);
  EXPECT_NEAR(plane.height_m({0.01, 0.01, 0.001}), 0.0, 1e-12);
  EXPECT_NEAR(thickness_m(slope()), 0.0, 1e-12);
}

TEST(Thickness, IsTheRootMeanSquareOfTheHeights) {
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i)
    points.push_back({0.001 * (i % 20), 0.001 * (i / 20), (i + i / 20) % 2 == 0 ? 0.0001 : -0.0001});
  EXPECT_NEAR(thickness_m(points), 0.0001, 1e-7);
}

TEST(LargestPlane, HasTheMembersOnItOnly) {
  std::vector<Vec3> points = slope();
  for (int i = 0; i < 100; ++i) points.push_back({0.01, 0.01, 0.01 + 0.0002 * i});
  const auto members = members_of_largest_plane(points, 1e-6, 0.5, {}, 1);
  ASSERT_EQ(members.size(), 400U);
  EXPECT_EQ(members.back(), 399U);
  EXPECT_TRUE(members_of_largest_plane(points, 1e-6, 0.9, {}, 1).empty());
}

TEST(Slab, LiesBehindThePlaneAsSeenFromTheEye) {
  std::vector<Vec3> points;
  for (int i = 0; i < 400; ++i) points.push_back({0.001 * (i % 20), 0.001 * (i / 20), 0.0});
  const auto slab = slab_of(points, Point<SceneFrame>{{0.01, 0.01, 1.0}}, {});
  EXPECT_NEAR(slab.size_m.x, 0.0095, 0.0006);
  EXPECT_NEAR(slab.size_m.y, 0.0095, 0.0006);
  EXPECT_NEAR(slab.size_m.z, 0.01 * 0.019, 2e-5);
  EXPECT_NEAR(slab.scene_from_shape.translation_m.z, -slab.size_m.z, 1e-9);
  EXPECT_NEAR(slab_of(points, std::nullopt, {}).scene_from_shape.translation_m.z, 0.0, 1e-9);
}

}  // namespace
}  // namespace palpable::sculpt
