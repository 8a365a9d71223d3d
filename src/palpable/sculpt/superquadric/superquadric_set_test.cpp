// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/superquadric_set.hpp"

#include "palpable/models/field/superquadric_distance.hpp"
#include "palpable/models/field/superquadric_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

using models::Superquadric;

Superquadric ball(Vec3 at, double radius_m) {
  Superquadric s;
  s.size_m = {radius_m, radius_m, radius_m};
  s.scene_from_shape.translation_m = at;
  return s;
}

Superquadric box(Vec3 at, Vec3 half_m) {
  Superquadric s;
  s.size_m = half_m;
  s.e1 = s.e2 = 0.1;
  s.scene_from_shape.translation_m = at;
  return s;
}

/// Evenly distributed points of a surface: no two are nearer than `spacing_m`.
std::vector<Vec3> even_points(const Superquadric& shape, double spacing_m) {
  std::vector<Vec3> points;
  for (const Vec3 p : models::mesh_of(shape, 0.25 * spacing_m).vertices_m)
    if (std::all_of(points.begin(), points.end(), [&](Vec3 q) { return norm(p - q) >= spacing_m; }))
      points.push_back(p);
  return points;
}

/// Noisy points of several shapes, without those inside another shape. If an eye is given, only points that
/// face it.
std::vector<Vec3> points_of(const std::vector<Superquadric>& shapes, double spacing_m, double noise_m,
                            const std::optional<Vec3>& eye = std::nullopt) {
  std::vector<models::SuperquadricDistance> distances;
  for (const Superquadric& s : shapes) distances.push_back(*models::SuperquadricDistance::from(s));
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, noise_m);
  std::vector<Vec3> points;
  for (std::size_t k = 0; k < shapes.size(); ++k)
    for (const Vec3 place : even_points(shapes[k], spacing_m)) {
      bool seen = !eye || dot(*eye - place, distances[k].closest_point({place}).normal.v) > 0.0;
      for (std::size_t other = 0; other < shapes.size(); ++other)
        seen = seen && (other == k || distances[other].distance_m({place}) > 0.0);
      if (seen) points.push_back(place + Vec3{normal(random), normal(random), normal(random)});
    }
  return points;
}

/// Mean distance from noiseless points of the true shapes, those that face `eye`, to the surface of the
/// fitted union.
double error_m(const ShapeSet& set, const std::vector<Superquadric>& truth,
               const std::optional<Vec3>& eye = std::nullopt) {
  std::vector<models::SuperquadricDistance> shapes;
  for (const auto& s : set.shapes) shapes.push_back(*models::SuperquadricDistance::from(s.shape));
  double sum = 0.0;
  const auto points = points_of(truth, 0.004, 0.0, eye);
  for (const Vec3 p : points) sum += std::abs(closest_point(shapes, {p}).distance_m);
  return sum / static_cast<double>(points.size());
}

TEST(SuperquadricSet, OneShapeStaysOne) {
  const std::vector<Superquadric> truth{box({0.01, 0.02, 0.0}, {0.05, 0.03, 0.02})};
  const auto set = fit_superquadrics(points_of(truth, 0.004, 0.0003), {}, std::nullopt, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  EXPECT_EQ(set->shapes.size(), 1U);
  EXPECT_LT(error_m(*set, truth), 0.001);
}

/// Points on the six faces of a box with sharp edges, without noise.
std::vector<Vec3> points_of_exact_box(Vec3 half_m, std::size_t count) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> across(-1.0, 1.0);
  const std::array<double, 3> areas{half_m.y * half_m.z, half_m.z * half_m.x, half_m.x * half_m.y};
  std::discrete_distribution<int> face(areas.begin(), areas.end());
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, 3> at{across(random), across(random), across(random)};
    double& normal = at[static_cast<std::size_t>(face(random))];
    normal = normal < 0.0 ? -1.0 : 1.0;
    points.push_back({half_m.x * at[0], half_m.y * at[1], half_m.z * at[2]});
  }
  return points;
}

TEST(SuperquadricSet, ABoxWithSharpEdgesIsOneShape) {
  for (const Vec3 half_m : {Vec3{0.035, 0.028, 0.019}, Vec3{0.016, 0.019, 0.017}}) {
    const auto set = fit_superquadrics(points_of_exact_box(half_m, 4000), {}, std::nullopt, {}, Work{});
    ASSERT_TRUE(set) << set.error().sentence();
    ASSERT_EQ(set->shapes.size(), 1U);
    EXPECT_LT(set->error_m, 0.0003);
  }
}

// All sides are equal, and every k-th point may be one of the same side.
TEST(SuperquadricSet, ACubesPointsOnALatticeAreOneShape) {
  constexpr double kHalf_m = 0.03;
  constexpr int kSteps = 60;
  std::vector<Vec3> points;
  const auto at = [&](int i) { return kHalf_m * (2.0 * i / kSteps - 1.0); };
  for (int z = 0; z <= kSteps; ++z)
    for (int y = 0; y <= kSteps; ++y)
      for (int x = 0; x <= kSteps; ++x)
        if (x % kSteps == 0 || y % kSteps == 0 || z % kSteps == 0) points.push_back({at(x), at(y), at(z)});
  const auto set = fit_superquadrics(points, {}, std::nullopt, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  ASSERT_EQ(set->shapes.size(), 1U);
  for (const double half_m : {set->shapes[0].shape.size_m.x, set->shapes[0].shape.size_m.y})
    EXPECT_NEAR(half_m, kHalf_m, 0.0002);
}

TEST(SuperquadricSet, ThreeThatStandApartAreFound) {
  const std::vector<Superquadric> truth{
      ball({-0.1, 0.0, 0.0}, 0.03), box({0.0, 0.0, 0.0}, {0.02, 0.03, 0.04}), ball({0.1, 0.02, 0.0}, 0.02)};
  const auto set = fit_superquadrics(points_of(truth, 0.004, 0.0003), {}, std::nullopt, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  EXPECT_EQ(set->shapes.size(), 3U);
  EXPECT_LT(error_m(*set, truth), 0.001);
}

TEST(SuperquadricSet, TwoThatOverlapAreSeparated) {
  const std::vector<Superquadric> truth{box({0.0, 0.0, 0.0}, {0.06, 0.02, 0.02}),
                                        ball({0.0, 0.0, 0.045}, 0.03)};
  const auto set = fit_superquadrics(points_of(truth, 0.003, 0.0003), {}, std::nullopt, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  EXPECT_GE(set->shapes.size(), 2U);
  EXPECT_LE(set->shapes.size(), 4U);
  EXPECT_LT(error_m(*set, truth), 0.002);
}

TEST(SuperquadricSet, ABallOnATableSeenFromAboveIsASlabAndABall) {
  const Vec3 eye{0.0, -0.2, 0.6};
  const std::vector<Superquadric> truth{box({0.0, 0.0, -0.005}, {0.15, 0.1, 0.005}),
                                        ball({0.02, 0.0, 0.03}, 0.03)};
  const auto set =
      fit_superquadrics(points_of(truth, 0.003, 0.0003, eye), {}, Point<SceneFrame>{eye}, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  ASSERT_EQ(set->shapes.size(), 2U);
  // The table's front, and the ball.
  const Superquadric& table = set->shapes[0].shape;
  const double top_m = table.scene_from_shape.translation_m.z + table.size_m.z;
  EXPECT_NEAR(top_m, 0.0, 0.002);
  const Superquadric& seen = set->shapes[1].shape;
  EXPECT_LT(norm(seen.scene_from_shape.translation_m - Vec3{0.02, 0.0, 0.03}), 0.006);
  for (const double a : {seen.size_m.x, seen.size_m.y, seen.size_m.z}) EXPECT_NEAR(a, 0.03, 0.006);
}

TEST(SuperquadricSet, NoShapeReachesOutsideOfTheSilhouette) {
  // Two posts on a beam: a shape over all of them would fill the gap.
  const Vec3 eye{0.0, 0.0, 0.6};
  const std::vector<Superquadric> truth{box({0.0, -0.06, 0.0}, {0.09, 0.015, 0.02}),
                                        box({-0.07, 0.0, 0.0}, {0.015, 0.06, 0.02}),
                                        ball({0.07, 0.0, 0.0}, 0.04)};
  const auto set =
      fit_superquadrics(points_of(truth, 0.0025, 0.0, eye), {}, Point<SceneFrame>{eye}, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  std::vector<models::SuperquadricDistance> shapes;
  for (const Superquadric& s : truth) shapes.push_back(*models::SuperquadricDistance::from(s));
  std::size_t all = 0, outside = 0;
  for (const auto& fitted : set->shapes)
    for (const Vec3 p : models::mesh_of(fitted.shape, 0.008).vertices_m) {
      // The nearest that the line of sight comes to the true shapes.
      double least_m = std::numeric_limits<double>::infinity();
      for (double t = 0.85; t < 1.25; t += 0.01)
        least_m = std::min(least_m, closest_point(shapes, {eye + t * (p - eye)}).distance_m);
      ++all;
      if (least_m > 0.006) ++outside;
    }
  EXPECT_LT(static_cast<double>(outside), 0.02 * static_cast<double>(all));
  EXPECT_LT(error_m(*set, truth, eye), 0.002);
}

TEST(SuperquadricSet, TapersAShapeOnlyWhereThatPays) {
  Superquadric cone = box({0.0, 0.0, 0.0}, {0.03, 0.03, 0.06});
  cone.e1 = 0.5, cone.e2 = 1.0;
  cone.taper_x = cone.taper_y = -0.5;
  const auto tapered = fit_superquadrics(points_of({cone}, 0.004, 0.0002), {}, std::nullopt, {}, Work{});
  ASSERT_TRUE(tapered) << tapered.error().sentence();
  ASSERT_EQ(tapered->shapes.size(), 1U);
  EXPECT_NEAR(std::abs(tapered->shapes[0].shape.taper_x), 0.5, 0.1);
  const auto plain =
      fit_superquadrics(points_of({ball({}, 0.04)}, 0.004, 0.0002), {}, std::nullopt, {}, Work{});
  ASSERT_TRUE(plain) << plain.error().sentence();
  ASSERT_EQ(plain->shapes.size(), 1U);
  EXPECT_FALSE(plain->shapes[0].shape.deformed());
  ShapeSetOptions never;
  never.fit.deformation = FitDeformation::none;
  const auto undeformed =
      fit_superquadrics(points_of({cone}, 0.004, 0.0002), {}, std::nullopt, never, Work{});
  ASSERT_TRUE(undeformed) << undeformed.error().sentence();
  for (const auto& fitted : undeformed->shapes) EXPECT_FALSE(fitted.shape.deformed());
}

TEST(SuperquadricSet, PointsOfDifferentLabelsNeverShareAShape) {
  const auto points = points_of({ball({0.0, 0.0, 0.0}, 0.03)}, 0.003, 0.0);
  std::vector<std::uint8_t> labels;
  for (const Vec3 p : points) labels.push_back(p.x < 0.0 ? 1 : 2);
  const auto set = fit_superquadrics(points, labels, std::nullopt, {}, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  EXPECT_GE(set->shapes.size(), 2U);
}

TEST(SuperquadricSet, ObeysItsParameters) {
  std::vector<Vec3> plate;
  for (int i = 0; i < 900; ++i) plate.push_back({0.001 * (i % 30), 0.001 * (i / 30), 0.0});
  ShapeSetOptions options;
  for (const Parameter& p : parameters_of(options)) EXPECT_TRUE(set_parameter(p, p.get())) << p.name;
  options.slab.thickness = 0.01;
  const auto set = fit_superquadrics(plate, {}, std::nullopt, options, Work{});
  ASSERT_TRUE(set) << set.error().sentence();
  ASSERT_EQ(set->shapes.size(), 1U);
  // Half axis: half of a hundredth of the side of 29 mm.
  EXPECT_NEAR(set->shapes[0].shape.size_m.z, 0.005 * 0.029, 1e-6);
  options.gap_spacings = 0.0;
  EXPECT_FALSE(fit_superquadrics(plate, {}, std::nullopt, options, Work{}));
}

TEST(SuperquadricSet, RefusesTooFewPointsPointsAtOnePlaceAndNonFiniteOnes) {
  const auto fit = [](const std::vector<Vec3>& points) {
    return fit_superquadrics(points, {}, std::nullopt, {}, Work{});
  };
  EXPECT_FALSE(fit(std::vector<Vec3>(5)));
  EXPECT_FALSE(fit(std::vector<Vec3>(100, Vec3{1.0, 2.0, 3.0})));
  std::vector<Vec3> points = points_of({ball({}, 0.03)}, 0.01, 0.0);
  points[3].y = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(fit(points));
}

}  // namespace
}  // namespace palpable::sculpt
