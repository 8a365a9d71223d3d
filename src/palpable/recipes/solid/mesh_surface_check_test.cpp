// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/mesh_surface_check.hpp"

#include <string>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

std::string said_of(const Mesh& mesh) {
  const auto checked = check_surface(mesh);
  return checked ? "" : checked.error().message;
}

/// Two triangles; what their corners have in common decides.
Mesh mesh_of(Vec3 a, Vec3 b, Vec3 c, Vec3 d) { return {{a, b, c, d}, {{0, 1, 2}, {1, 2, 3}}, {}}; }

TEST(MeshSurfaceCheck, TakesEverythingWithATriangleThatHasAnArea) {
  EXPECT_EQ(said_of(mesh_of({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0})), "");
  EXPECT_EQ(said_of(mesh_of({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1e-5, 0})), "");
  EXPECT_EQ(said_of(mesh_of({1e6, 0, 0}, {1e6 + 40, 0, 0}, {1e6, 30, 0}, {1e6, 1, 9})), "");
}

TEST(MeshSurfaceCheck, RefusesPointsAndLines) {
  EXPECT_EQ(said_of(mesh_of({1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3})),
            "is a mesh without surface: all its corners are at one place");
  EXPECT_EQ(said_of(mesh_of({0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3})),
            "is a mesh without surface: the corners of each triangle are on one line");
  EXPECT_EQ(said_of(mesh_of({0, 0, 0}, {0.1, 0.7, 0.3}, {0.2, 1.4, 0.6}, {0.3, 2.1, 0.9})),
            "is a mesh without surface: the corners of each triangle are on one line");
  Mesh repeated = mesh_of({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
  repeated.triangles = {{0, 1, 1}, {2, 2, 3}};
  EXPECT_EQ(said_of(repeated), "is a mesh without surface: the corners of each triangle are on one line");
}

Vec3 in_single(Vec3 v) {
  const auto rounded = [](double x) { return static_cast<double>(static_cast<float>(x)); };
  return {rounded(v.x), rounded(v.y), rounded(v.z)};
}

TEST(MeshSurfaceCheck, DoesNotCallTheTrianglesOfASmallMeshFarAwayLines) {
  // At 5 km single precision has steps of 0.5 mm.
  const Vec3 far{5000, 2500, 0};
  const Vec3 a = far, b = far + Vec3{0.004, 0, 0}, c = far + Vec3{0, 0.002, 0},
             d = far + Vec3{0.004, 0.002, 0};
  EXPECT_EQ(said_of(mesh_of(a, b, c, d)), "");
  EXPECT_EQ(
      said_of(mesh_of(in_single(a), in_single(b), in_single(c), in_single(d))),
      "is a mesh without surface: the corners of each triangle are on one line, as far as its coordinates "
      "tell; 5000 from its origin its coordinates have steps of 0.0006: move it to its origin");
}

TEST(MeshSurfaceCheck, SaysThatNothingRemainsOfASmallMeshFarFromItsOrigin) {
  const Vec3 far{1e8, 1e8, 0};
  EXPECT_EQ(
      said_of(mesh_of(in_single(far), in_single(far + Vec3{9, 0, 0}), in_single(far + Vec3{0, 9, 0}),
                      in_single(far + Vec3{9, 9, 0}))),
      "is a mesh without surface: the corners of each triangle are on one line, as far as its coordinates "
      "tell; 100000008 from its origin its coordinates have steps of 12: move it to its origin");
  EXPECT_NEAR(coordinate_step(mesh_of(in_single(far), {}, {}, {})), 12.0, 0.1);
  // In double precision it has its shape.
  EXPECT_NEAR(coordinate_step(mesh_of(far + Vec3{0.3, 0, 0}, {}, {}, {})), 0.0, 1e-7);
  EXPECT_EQ(said_of(mesh_of(far, far + Vec3{0.3, 0, 0}, far + Vec3{0, 0.3, 0}, far + Vec3{0.1, 0.1, 0.7})),
            "");
}

}  // namespace
}  // namespace palpable::recipes
