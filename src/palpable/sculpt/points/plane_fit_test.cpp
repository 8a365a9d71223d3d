// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/plane_fit.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

TEST(PlaneFit, FindsThePlaneOfPointsOnIt) {
  const Vec3 normal = unit({1.0, -2.0, 2.0}), u = unit({2.0, 1.0, 0.0}), v = cross(normal, u);
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i)
    points.push_back(0.3 * normal + std::cos(1.0 * i) * u + 0.5 * std::sin(1.0 * i) * v);
  const Plane plane = plane_through(points);
  EXPECT_NEAR(std::abs(dot(plane.normal, normal)), 1.0, 1e-12);
  EXPECT_NEAR(std::abs(plane.offset_m), 0.3, 1e-12);
  for (const Vec3& p : points) EXPECT_NEAR(plane.height_m(p), 0.0, 1e-12);
}

TEST(PlaneFit, LiesBetweenPointsOnBothSides) {
  const std::vector<Vec3> points{{1, 0, 0.1}, {-1, 0, 0.1}, {0, 1, -0.1}, {0, -1, -0.1}};
  const Plane plane = plane_through(points);
  EXPECT_NEAR(std::abs(plane.normal.z), 1.0, 1e-12);
  EXPECT_NEAR(plane.offset_m, 0.0, 1e-12);
}

TEST(PlaneFit, OfPointsInOnePlaceIsLevel) {
  const std::vector<Vec3> points(5, Vec3{1.0, 2.0, 3.0});
  const Plane plane = plane_through(points);
  EXPECT_EQ(plane.normal, (Vec3{0.0, 0.0, 1.0}));
  EXPECT_EQ(plane.height_m({7.0, 8.0, 3.5}), 0.5);
}

}  // namespace
}  // namespace palpable::sculpt
