// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/cloud_normals.hpp"

#include "palpable/sculpt/points/cloud_surface.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// Points evenly distributed on a ball (Fibonacci spiral), with noise along the radius.
void add_ball(PointCloud& cloud, Vec3 middle_m, double radius_m, int count, double noise_m, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, noise_m > 0.0 ? noise_m : 1.0);
  const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
  for (int i = 0; i < count; ++i) {
    const double z = 1.0 - 2.0 * (i + 0.5) / count, r = std::sqrt(1.0 - z * z);
    const Vec3 way{r * std::cos(golden * i), r * std::sin(golden * i), z};
    cloud.places_m.push_back(middle_m + (radius_m + (noise_m > 0.0 ? noise(random) : 0.0)) * way);
  }
}

TEST(CloudNormals, AreThoseOfTheBallTheyLieOn) {
  PointCloud cloud;
  add_ball(cloud, {0.1, 0.2, -0.3}, 0.05, 4000, 0.0, 1);
  const auto done = with_normals(cloud, Work{});
  ASSERT_TRUE(done);
  ASSERT_EQ(done->normals.size(), 4000U);
  for (std::size_t i = 0; i < 4000; ++i)
    ASSERT_GT(dot(done->normals[i], unit(done->places_m[i] - Vec3{0.1, 0.2, -0.3})), 0.998);
}

TEST(CloudNormals, FaceOutOfEveryPartAndThroughNoise) {
  PointCloud cloud;
  add_ball(cloud, {-0.05, 0.0, 0.0}, 0.03, 3000, 2e-4, 2);
  add_ball(cloud, {0.05, 0.0, 0.0}, 0.015, 1500, 1e-4, 3);
  const auto done = with_normals(cloud, Work{});
  ASSERT_TRUE(done);
  for (std::size_t i = 0; i < done->places_m.size(); ++i) {
    const Vec3 p = done->places_m[i];
    ASSERT_GT(dot(done->normals[i], unit(p - Vec3{p.x < 0.0 ? -0.05 : 0.05, 0.0, 0.0})), 0.8);
  }
}

TEST(CloudNormals, MakeASolidOfPointsAlone) {
  // A box's corners and edges, where neighbours lie on three sides.
  PointCloud cloud;
  constexpr int kSide = 30;
  for (int i = 0; i <= kSide; ++i)
    for (int j = 0; j <= kSide; ++j) {
      const double u = 0.04 * i / kSide - 0.02, v = 0.04 * j / kSide - 0.02;
      for (const double w : {-0.02, 0.02})
        for (const Vec3 p : {Vec3{u, v, w}, Vec3{u, w, v}, Vec3{w, u, v}}) cloud.places_m.push_back(p);
    }
  const auto done = with_normals(cloud, Work{});
  ASSERT_TRUE(done);
  const auto surface = surface_of_cloud(*done, {}, Work{});
  ASSERT_TRUE(surface) << surface.error().sentence();
  const auto solid = solid_from_mesh(*surface, 2e-4, Work{});
  ASSERT_TRUE(solid);
  DistanceSource::Hint hint;
  EXPECT_NEAR(solid->distance->at({0.0, 0.0, 0.0}, hint).distance_m, -0.02, 0.001);
  EXPECT_NEAR(solid->distance->at({0.0, 0.0, 0.03}, hint).distance_m, 0.01, 0.001);
}

TEST(CloudNormals, RefusesWhatHasNoSurface) {
  PointCloud few;
  few.places_m.resize(10);
  EXPECT_FALSE(with_normals(few, Work{}));
  PointCloud broken;
  add_ball(broken, {}, 0.01, 100, 0.0, 1);
  broken.places_m[5].y = std::numeric_limits<double>::infinity();
  EXPECT_FALSE(with_normals(broken, Work{}));
}

}  // namespace
}  // namespace palpable::sculpt
