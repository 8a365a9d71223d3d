// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include "palpable/sculpt/solid/nearest_in_balls.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// Random triangles in a ball of 50 mm, one in ten a sliver.
Mesh soup(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const auto any = [&] {
    const double x = normal(random), y = normal(random), z = normal(random);
    return Vec3{x, y, z};
  };
  Mesh mesh;
  for (std::uint32_t t = 0; t < 3000; ++t) {
    const Vec3 a = (0.05 + 0.001 * normal(random)) * unit(any());
    const Vec3 b = a + 0.002 * any();
    const Vec3 c = t % 10 == 0 ? 0.5 * (a + b) + 1e-6 * any() : a + 0.002 * any();
    for (const Vec3 v : {a, b, c}) mesh.vertices_m.push_back(v);
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

double by_trying_all_m(const Mesh& mesh, Vec3 p) {
  double least_m2 = 1.0;
  for (const auto& t : mesh.triangles)
    least_m2 = std::min(
        least_m2, nearest_on_triangle(p, mesh.vertices_m[t[0]], mesh.vertices_m[t[1]], mesh.vertices_m[t[2]])
                      .squared_distance_m2);
  return std::sqrt(least_m2);
}

TEST(TriangleTree, FindsTheSameNearestTriangleAsAnExhaustiveSearch) {
  const Mesh mesh = soup(1);
  const TriangleTree tree(mesh);
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> uniform(-0.06, 0.06);
  for (int i = 0; i < 500; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    // In the middle of the ball, nearly all triangles have the same distance.
    const Vec3 p = (i % 5 == 0 ? 0.1 : 1.0) * Vec3{x, y, z};
    const double truth_m = by_trying_all_m(mesh, p);
    const double found_m = std::sqrt(tree.nearest(p, 0).squared_distance_m2);
    EXPECT_GE(found_m, truth_m);
    EXPECT_LE(found_m * (1.0 - TriangleTree::kNearestSlack), truth_m + 1e-12);
  }
}

TEST(TriangleTree, FindsTheSameInTheListsOfNestedBalls) {
  const Mesh mesh = soup(3);
  const TriangleTree tree(mesh);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto in_cube = [&](Vec3 centre, double half_m) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return centre + half_m * Vec3{x, y, z};
  };
  std::size_t short_lists = 0;
  for (int i = 0; i < 60; ++i) {
    DistanceSource::Hint hint;
    Vec3 centre = in_cube({}, i % 3 == 0 ? 0.005 : 0.05);
    double half_m = 0.004;
    for (int depth = 0; depth < 5; ++depth) {
      enter_ball(tree, centre, std::sqrt(3.0) * half_m, hint);
      short_lists += hint.balls[hint.entered - 1].entered_again;
      for (int k = 0; k < 4; ++k) {
        const Vec3 p = in_cube(centre, half_m);
        const double truth_m = by_trying_all_m(mesh, p);
        const double found_m = std::sqrt(nearest_in_ball(tree, p, hint).squared_distance_m2);
        EXPECT_GE(found_m, truth_m);
        EXPECT_LE(found_m * (1.0 - TriangleTree::kNearestSlack), truth_m + 1e-12);
      }
      centre = in_cube(centre, 0.5 * half_m);
      half_m *= 0.5;
    }
    for (int depth = 0; depth < 5; ++depth) leave_ball(hint);
    EXPECT_EQ(hint.entered, 0U);
  }
  EXPECT_GT(short_lists, 10U);
}

/// A closed ball of 50 mm, its facets at most 0.1 % inside it.
Mesh ball(Vec3 centre_m) {
  constexpr std::uint32_t kRings = 60, kAround = 120;
  Mesh mesh;
  for (std::uint32_t ring = 0; ring <= kRings; ++ring)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const double down = std::numbers::pi * ring / kRings, round = 2.0 * std::numbers::pi * k / kAround;
      mesh.vertices_m.push_back(centre_m + 0.05 * Vec3{std::sin(down) * std::cos(round),
                                                       std::sin(down) * std::sin(round), std::cos(down)});
    }
  for (std::uint32_t ring = 0; ring < kRings; ++ring)
    for (std::uint32_t k = 0; k < kAround; ++k) {
      const std::uint32_t a = ring * kAround + k, b = ring * kAround + (k + 1) % kAround;
      if (ring > 0) mesh.triangles.push_back({a, a + kAround, b});
      if (ring + 1 < kRings) mesh.triangles.push_back({b, a + kAround, b + kAround});
    }
  return mesh;
}

TEST(TriangleTree, WindsOnceAroundTheInsideOfABallAlsoAfterItMoved) {
  const Mesh mesh = ball({}), moved = ball({0.03, 0.0, 0.0});
  TriangleTree tree(mesh);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  const auto check_around = [&](Vec3 centre_m) {
    for (int i = 0; i < 2000; ++i) {
      const double x = uniform(random), y = uniform(random), z = uniform(random);
      // Half of the places lie close to the surface, on both of its sides.
      const Vec3 from =
          i % 2 == 0 ? Vec3{x, y, z} : 0.05 * (1.0 + (i % 4 == 1 ? 1e-5 : -0.002)) * unit({x, y, z});
      // Between the facets and the ball.
      if (norm(from) > 0.04995 && norm(from) < 0.05) continue;
      EXPECT_NEAR(tree.winding(centre_m + from), norm(from) < 0.05 ? 1.0 : 0.0, 0.02);
    }
  };
  check_around({});
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  tree.move(moved, all);
  check_around({0.03, 0.0, 0.0});
}

}  // namespace
}  // namespace palpable::sculpt
