// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/free_space.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kSlack_m = 0.001;

/// Even points of a ball around 0 (Fibonacci's spiral), without those that `hidden` excludes.
template <class Hidden>
std::vector<Vec3> ball_points(double radius_m, Hidden&& hidden) {
  constexpr int kCount = 8000;
  std::vector<Vec3> points;
  for (int k = 0; k < kCount; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / kCount, r = std::sqrt(1.0 - z * z);
    const double angle = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
    const Vec3 p{r * std::cos(angle), r * std::sin(angle), z};
    if (!hidden(p)) points.push_back(radius_m * p);
  }
  return points;
}

models::Superquadric ellipsoid(Vec3 half_m) {
  models::Superquadric s;
  s.size_m = half_m;
  return s;
}

TEST(FreeSpace, OfOneEyeIsBeforeAndBesideWhatItSees) {
  const auto seen = ball_points(0.05, [](Vec3 p) { return p.z < 0.1; });
  const FreeSpace space(seen, Point<SceneFrame>{{0.0, 0.0, 0.6}}, kSlack_m, {});
  EXPECT_NEAR(space.depth_m({0.0, 0.0, 0.07}), 0.019, 0.001);
  EXPECT_NEAR(space.depth_m({0.07, 0.0, 0.0}), 0.02, 0.003);
  EXPECT_EQ(space.depth_m({0.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(space.depth_m({0.0, 0.0, -0.2}), 0.0);  // hidden
  EXPECT_EQ(space.depth_m({0.0, 0.0, 0.8}), 0.0);   // behind the eye
}

TEST(FreeSpace, OfPointsAllAroundIsOutsideThoughTheirSolidHasAHole) {
  const auto points = ball_points(0.05, [](Vec3 p) { return p.y < -0.9; });
  const FreeSpace space(points, std::nullopt, kSlack_m, {});
  EXPECT_EQ(space.depth_m({0.0, 0.0, 0.0}), 0.0);
  EXPECT_EQ(space.depth_m({0.0, 0.02, 0.0}), 0.0);
  EXPECT_GT(space.depth_m({0.07, 0.0, 0.0}), 0.01);
  EXPECT_GT(space.depth_m({0.04, 0.04, 0.04}), 0.01);
  for (const Vec3 p : space.places_around(points, 0.05, 100, 1)) EXPECT_GT(norm(p), 0.04);
}

TEST(FreeSpace, TrimsAShapeToWhatItLeaves) {
  const FreeSpace space(ball_points(0.05, [](Vec3) { return false; }), std::nullopt, kSlack_m, {});
  const models::Superquadric fitting = ellipsoid({0.05, 0.05, 0.05});
  EXPECT_EQ(surface_beyond(space, fitting).share, 0.0);
  const auto kept = trimmed(space, fitting, 0.02);
  ASSERT_TRUE(kept);
  EXPECT_EQ(kept->size_m.x, 0.05);
  models::Superquadric shifted = ellipsoid({0.05, 0.05, 0.053});
  shifted.scene_from_shape.translation_m = {0.0, 0.0, 0.003};
  EXPECT_GT(surface_beyond(space, shifted).share, 0.05);
  const auto within = trimmed(space, shifted, 0.02);
  ASSERT_TRUE(within);
  EXPECT_LE(surface_beyond(space, *within).share, 0.02);
  EXPECT_GT(within->size_m.z, 0.04);
  EXPECT_FALSE(trimmed(space, ellipsoid({0.1, 0.1, 0.1}), 0.02));
}

}  // namespace
}  // namespace palpable::sculpt
