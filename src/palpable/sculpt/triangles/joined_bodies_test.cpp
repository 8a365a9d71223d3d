// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/joined_bodies.hpp"

#include "palpable/sculpt/solid/sheet_scene.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"
#include "palpable/sculpt/triangles/mesh_orientation.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kSize_m = 0.01;
constexpr TouchingDistances kTouching{.same_m = 1e-9, .touching_m = 1e-6};

/// A cube without the face at `open` (outward normal along an axis); its faces have n times n cells.
Mesh open_cube(Vec3 least, Vec3 open, std::uint32_t n) {
  const Vec3 x{kSize_m, 0, 0}, y{0, kSize_m, 0}, z{0, 0, kSize_m};
  Mesh cube;
  for (const auto& [u, v, w] : {std::array{x, y, z}, {y, z, x}, {z, x, y}})
    for (const bool far : {false, true}) {
      if (dot(open, w) * (far ? 1.0 : -1.0) > 0.0) continue;
      const Vec3 corner = far ? least + w : least;
      cube = together(std::move(cube), grid_sheet(n, n, [&](double a, double b) {
                        return corner + (far ? a : b) * u + (far ? b : a) * v;
                      }));
    }
  return cube;
}

/// Two cubes side by side along x, without the faces at `open`. Their rims meet but for `gap_m` and have
/// only corners in common.
Mesh two_cubes(Vec3 first_open, Vec3 second_open, double gap_m = 0.0) {
  std::size_t degenerate = 0;
  return welded(together(open_cube({}, first_open, 2), open_cube({kSize_m + gap_m, 0, 0}, second_open, 3)),
                degenerate);
}

bool is_joined(Mesh& mesh) {
  return join_bodies(mesh, holes_of(mesh.vertices_m, mesh.triangles), kTouching, {}, 1);
}

TEST(JoinBodies, CubesThatAreOpenTowardsEachOtherAreOneBody) {
  Mesh mesh = two_cubes({1, 0, 0}, {-1, 0, 0});
  ASSERT_EQ(holes_of(mesh.vertices_m, mesh.triangles).size(), 2U);
  EXPECT_TRUE(is_joined(mesh));
  EXPECT_EQ(holes_of(mesh.vertices_m, mesh.triangles).size(), 0U);
  EXPECT_FALSE(is_joined(mesh));
}

TEST(JoinBodies, CubesWhoseLidsWouldBeAsLargeStayTwo) {
  Mesh mesh = two_cubes({0, 0, 1}, {0, 0, 1});
  const Mesh given = mesh;
  ASSERT_EQ(holes_of(mesh.vertices_m, mesh.triangles).size(), 2U);
  EXPECT_FALSE(is_joined(mesh));
  EXPECT_EQ(mesh.triangles, given.triangles);
}

TEST(JoinBodies, RimsThatDoNotTouchStayApart) {
  Mesh mesh = two_cubes({1, 0, 0}, {-1, 0, 0}, 1e-6);
  EXPECT_FALSE(is_joined(mesh));
}

}  // namespace
}  // namespace palpable::sculpt
