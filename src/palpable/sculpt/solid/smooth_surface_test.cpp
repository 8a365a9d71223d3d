// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/smooth_surface.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/solid/mesh_distance.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kRadius_m = 0.02, kSpacing_m = 0.001;

Mesh sphere() {
  models::Superquadric s;
  s.size_m = {kRadius_m, kRadius_m, kRadius_m};
  return models::mesh_of(s, kSpacing_m);
}

/// Points from 4 mm inside to 4 mm outside the ball.
Vec3 place_near(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> depth(-0.004, 0.004);
  const double x = normal(random), y = normal(random), z = normal(random);
  return (kRadius_m + depth(random)) * unit(Vec3{x, y, z});
}

TEST(SmoothSurface, IsTheBallThatItsFacetsApproximate) {
  const Mesh mesh = sphere();
  const SmoothSurface smooth(mesh);
  const auto facets = mesh_distance(mesh, mesh);
  std::mt19937_64 random(4);
  DistanceSource::Hint hint, other;
  double worst_facet_m = 0.0;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = place_near(random);
    const models::DistanceSample s = smooth.at(p, hint);
    ASSERT_NEAR(s.distance_m, norm(p) - kRadius_m, 2e-7);
    ASSERT_LT(norm(s.gradient - unit(p)), 1e-3);
    worst_facet_m =
        std::max(worst_facet_m, std::abs(facets->at(p, other).distance_m - (norm(p) - kRadius_m)));
  }
  // A chord of 1 mm is 6 um below the surface of the ball.
  EXPECT_GT(worst_facet_m, 2e-6);
}

TEST(SmoothSurface, KeepsEdgesSharp) {
  const Mesh mesh = box_mesh({-0.01, -0.02, -0.03}, {0.01, 0.02, 0.03});
  const SmoothSurface smooth(mesh);
  const auto exact = mesh_distance(mesh, mesh);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-0.04, 0.04);
  DistanceSource::Hint hint, other;
  for (int i = 0; i < 3000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    ASSERT_NEAR(smooth.at({x, y, z}, hint).distance_m, exact->at({x, y, z}, other).distance_m, 1e-9 + 2e-5);
  }
}

/// Like the result of a scanner: vertices displaced along their normals by up to `share` of the side length
/// of the facets.
Mesh noisy_sphere(double share) {
  Mesh mesh = sphere();
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Vec3& v : mesh.vertices_m) v = (1.0 + share * kSpacing_m / kRadius_m * uniform(random)) * v;
  return mesh;
}

/// The mean over the points of the tolerated angle between the directions of a field and of the surface,
/// radians.
double mean_coarse_turn(const Mesh& mesh, const SmoothSurface::Rounding& rounding) {
  const SmoothSurface smooth(mesh, rounding);
  std::mt19937_64 random(10);
  DistanceSource::Hint hint;
  double sum = 0.0;
  for (int i = 0; i < 1000; ++i) {
    static_cast<void>(smooth.at(place_near(random), hint));
    sum += hint.coarse_turn / 1000.0;
  }
  return sum;
}

TEST(SmoothSurface, DistinguishesAScansNoiseFromCurvature) {
  SmoothSurface::Rounding noise_only;
  noise_only.coarse_share = 0.0;
  noise_only.noise_turn_share = 1.0;
  // The angle between neighbouring facets of the ball is 3 degrees everywhere.
  const double smooth = mean_coarse_turn(sphere(), noise_only);
  const double noisy = mean_coarse_turn(noisy_sphere(0.05), noise_only);
  EXPECT_GT(noisy, 0.02);
  EXPECT_LT(smooth, 0.3 * noisy);
  // Noise of twice the amplitude rotates the normals by nearly twice the angle.
  EXPECT_NEAR(mean_coarse_turn(noisy_sphere(0.1), noise_only), 2.0 * noisy, 0.4 * noisy);
  noise_only.noise_turn_share = 0.0;
  EXPECT_EQ(mean_coarse_turn(noisy_sphere(0.05), noise_only), 0.0);
}

TEST(SmoothSurface, EqualsANewSurfaceAfterItsVerticesMoved) {
  const Mesh before = sphere();
  Mesh after = before;
  SmoothSurface moved(before);
  std::vector<SmoothSurface::Move> moves;
  for (std::uint32_t v = 0; v < after.vertices_m.size(); ++v) {
    if (after.vertices_m[v].z < 0.5 * kRadius_m) continue;
    after.vertices_m[v] = 1.05 * after.vertices_m[v];
    moves.push_back({v, after.vertices_m[v]});
  }
  ASSERT_GT(moves.size(), 100U);
  moved.move(moves);
  const SmoothSurface made(after);
  std::mt19937_64 random(6);
  DistanceSource::Hint hint, other;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = place_near(random);
    const double distance_m = made.at(p, other).distance_m;
    ASSERT_NEAR(moved.at(p, hint).distance_m, distance_m,
                1e-6 + 2.0 * TriangleTree::kNearestSlack * std::abs(distance_m));
  }
  EXPECT_EQ(moved.bounds().most_m.z, made.bounds().most_m.z);
}

TEST(SmoothSurface, GivesTheSameInsideAnEnteredBall) {
  const SmoothSurface smooth(sphere());
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-0.57, 0.57);
  for (int i = 0; i < 300; ++i) {
    const Vec3 centre = place_near(random);
    DistanceSource::Hint hint, other;
    smooth.enter(centre, 0.002, hint);
    smooth.enter(centre, 0.0005, hint);
    for (int k = 0; k < 10; ++k) {
      const double x = uniform(random), y = uniform(random), z = uniform(random);
      const Vec3 p = centre + 0.0005 * Vec3{x, y, z};
      const double distance_m = smooth.at(p, other).distance_m;
      ASSERT_NEAR(smooth.at(p, hint).distance_m, distance_m,
                  1e-7 + 2.0 * TriangleTree::kNearestSlack * std::abs(distance_m));
    }
    smooth.leave(hint);
    smooth.leave(hint);
    EXPECT_EQ(hint.entered, 0U);
  }
}

}  // namespace
}  // namespace palpable::sculpt
