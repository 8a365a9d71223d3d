// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/touching_edges.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

double area_of(const Mesh& mesh) {
  double sum = 0.0;
  for (const auto& t : mesh.triangles)
    sum += 0.5 * norm(cross(mesh.vertices_m[t[1]] - mesh.vertices_m[t[0]],
                            mesh.vertices_m[t[2]] - mesh.vertices_m[t[0]]));
  return sum;
}

/// Adds a face of two triangles whose corners are moved at random by about `by_m`.
void add_face(Mesh& mesh, const std::array<Vec3, 4>& corners, double by_m, std::mt19937_64& random) {
  std::normal_distribution<double> noise(0.0, by_m);
  const auto first = static_cast<std::uint32_t>(mesh.vertices_m.size());
  for (const Vec3& corner : corners)
    mesh.vertices_m.push_back(corner + Vec3{noise(random), noise(random), noise(random)});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void add_box(Mesh& mesh, Vec3 least, Vec3 most, double by_m, std::mt19937_64& random) {
  const auto corner = [&](int i) {
    return Vec3{i & 1 ? most.x : least.x, i & 2 ? most.y : least.y, i & 4 ? most.z : least.z};
  };
  for (const std::array<int, 4>& face :
       {std::array{0, 2, 3, 1}, std::array{4, 5, 7, 6}, std::array{0, 1, 5, 4}, std::array{2, 6, 7, 3},
        std::array{0, 4, 6, 2}, std::array{1, 3, 7, 5}})
    add_face(mesh, {corner(face[0]), corner(face[1]), corner(face[2]), corner(face[3])}, by_m, random);
}

TEST(TouchingEdges, OfFacesWhoseCornersNearlyCoincideAreDividedWithoutEnd) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    std::mt19937_64 random(seed);
    const double by_m = std::pow(10.0, std::uniform_real_distribution<double>(-10.0, -6.0)(random));
    Mesh mesh;
    add_box(mesh, {0, 0, 0}, {1, 1, 1}, by_m, random);
    add_box(mesh, {1, 0.25, 0}, {2, 0.75, 0.5}, by_m, random);
    // A sliver between corners that nearly coincide, and one along an edge.
    mesh.triangles.push_back({0, 4, 8});
    mesh.triangles.push_back({1, 2, 9});
    const double area = area_of(mesh);
    const auto divided = divide_touching_edges(mesh, 2e-7, TouchingEdges::all);
    if (!divided) continue;
    ASSERT_EQ(divided->part_of.size(), divided->mesh.triangles.size()) << seed;
    // A triangle with n vertices on its sides has n + 1 pieces.
    EXPECT_LE(divided->mesh.triangles.size(), mesh.triangles.size() * (mesh.vertices_m.size() + 1)) << seed;
    EXPECT_NEAR(area_of(divided->mesh), area, 1e-4) << seed;
  }
}

TEST(TouchingEdges, OfABoxAgainstAWallAreSharedAfterwards) {
  Mesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}, {1, 0, 0}, {2, 0, 0}, {1.5, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const auto divided = divide_touching_edges(mesh, 1e-9, TouchingEdges::all);
  ASSERT_TRUE(divided);
  EXPECT_EQ(divided->mesh.triangles.size(), 4U);
  EXPECT_NEAR(area_of(divided->mesh), area_of(mesh), 1e-12);
}

}  // namespace
}  // namespace palpable::sculpt
