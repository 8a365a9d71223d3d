// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/field/field_surface.hpp"
#include "palpable/sculpt/points/cloud_surface.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/superquadric_source.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

PointCloud cloud_of_a_ball(double radius_m, std::size_t count, double noise_m, double lowest = -1.0) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  PointCloud cloud;
  while (cloud.places_m.size() < count) {
    const Vec3 n = unit({normal(random), normal(random), normal(random)});
    if (n.z < lowest) continue;
    cloud.places_m.push_back((radius_m + noise_m * normal(random)) * n);
    cloud.normals.push_back(n);
  }
  return cloud;
}

double worst_radius_error(const Mesh& mesh, double radius_m) {
  double worst = 0.0;
  for (const Vec3 v : mesh.vertices_m) worst = std::max(worst, std::abs(norm(v) - radius_m));
  return worst;
}

TEST(CloudSurface, FollowsABallThroughItsPoints) {
  const auto mesh = surface_of_cloud(cloud_of_a_ball(0.03, 4000, 0.0), {}, {});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  EXPECT_TRUE(is_watertight(*mesh));
  // The points are 1.7 mm apart.
  EXPECT_LT(worst_radius_error(*mesh, 0.03), 3e-4);
}

TEST(CloudSurface, AveragesTheNoiseOfItsPoints) {
  constexpr double kNoise_m = 3e-4;
  const auto mesh = surface_of_cloud(cloud_of_a_ball(0.03, 10000, kNoise_m), {}, {});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  double squares = 0.0;
  for (const Vec3 v : mesh->vertices_m) squares += (norm(v) - 0.03) * (norm(v) - 0.03);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(mesh->vertices_m.size())), 0.6 * kNoise_m);
}

TEST(CloudSurface, ClosesWhatTheCameraDidNotSee) {
  // A fifth of the ball's height is missing below.
  const auto mesh = surface_of_cloud(cloud_of_a_ball(0.03, 3000, 0.0, -0.6), {}, {});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  const auto solid = solid_from_mesh(*mesh, 1e-4, {});
  ASSERT_TRUE(solid) << solid.error().sentence();
  // Sheets may touch each other at the border of the visible part, but nothing is open.
  EXPECT_EQ(solid->repair.closed_holes, 0U);
  DistanceSource::Hint hint;
  EXPECT_LT(solid->distance->at({0, 0, -0.015}, hint).distance_m, 0.0);
  EXPECT_GT(solid->distance->at({0, 0, -0.032}, hint).distance_m, 0.0);
}

TEST(CloudSurface, HasTheResolutionOfItsOptions) {
  const PointCloud cloud = cloud_of_a_ball(0.03, 4000, 0.0);
  CloudOptions coarse;
  coarse.resolution = 16;
  const auto few = surface_of_cloud(cloud, coarse, {}), many = surface_of_cloud(cloud, {}, {});
  ASSERT_TRUE(few && many);
  EXPECT_LT(2 * few->triangles.size(), many->triangles.size());
  coarse.neighbours = 2;
  const auto refused = surface_of_cloud(cloud, coarse, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
}

TEST(CloudSurface, RefusesWhatEnclosesNothing) {
  EXPECT_FALSE(surface_of_cloud({}, {}, {}));
  PointCloud bare = cloud_of_a_ball(0.03, 100, 0.0);
  bare.normals.clear();
  EXPECT_FALSE(surface_of_cloud(bare, {}, {}));
  PointCloud plane;
  for (int i = 0; i < 400; ++i) {
    plane.places_m.push_back({0.001 * (i % 20), 0.001 * (i / 20), 0.01});
    plane.normals.push_back({0, 0, 1});
  }
  const auto flat = surface_of_cloud(plane, {}, {});
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().code, ErrorCode::invalid_input);
  PointCloud broken = cloud_of_a_ball(0.03, 100, 0.0);
  broken.places_m[7].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(surface_of_cloud(broken, {}, {}));
}

TEST(FieldSurface, KeepsABoxsEdgesSharp) {
  const Vec3 low{-0.02, -0.015, -0.01}, high{0.0201, 0.0151, 0.0101};
  const auto solid = solid_from_mesh(box_mesh(low, high), 1e-4, {});
  ASSERT_TRUE(solid);
  FieldOptions options;
  options.resolution = 128;
  const auto field = field_from_source(*solid->distance, options, {});
  ASSERT_TRUE(field);
  const auto mesh = surface_of_field(*field, 2.0 * field->cell_m(), {});
  ASSERT_TRUE(mesh) << mesh.error().sentence();
  EXPECT_TRUE(is_watertight(*mesh));
  const Box box = bounds_of(*mesh);
  EXPECT_LT(norm(box.least_m - low) + norm(box.most_m - high), 2.0 * field->cell_m());
  for (const Vec3 v : mesh->vertices_m)
    ASSERT_LT(std::abs(box_distance(v, low, high)), 0.5 * field->cell_m());
}

TEST(SuperquadricSource, BecomesAFieldOfTheirUnion) {
  models::Superquadric ball;
  ball.size_m = {0.01, 0.01, 0.01};
  models::Superquadric beside = ball;
  beside.scene_from_shape.translation_m = {0.03, 0.0, 0.0};
  const auto source = distance_of(std::vector{ball, beside});
  ASSERT_TRUE(source) << source.error().sentence();
  FieldOptions options;
  options.resolution = 32;
  const auto field = field_from_source(**source, options, {});
  ASSERT_TRUE(field) << field.error().sentence();
  EXPECT_NEAR(field->sample({{0.0, 0.0, 0.011}}).distance_m, 0.001, 4e-5);
  EXPECT_NEAR(field->sample({{0.03, 0.008, 0.0}}).distance_m, -0.002, 4e-5);
  EXPECT_GT(dot(field->sample({{0.03, 0.0099, 0.0}}).gradient.v, {0, 1, 0}), 0.99);
  models::Superquadric wrong = ball;
  wrong.e1 = 3.0;
  EXPECT_FALSE(distance_of(std::vector{wrong}));
}

}  // namespace
}  // namespace palpable::sculpt
