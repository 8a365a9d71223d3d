// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/mesh.hpp"

#include <utility>

#include <gtest/gtest.h>

namespace palpable {
namespace {

// A square of two triangles in z = 0, and a triangle of half its size that stands on its first corner.
Mesh folded_sheet() {
  Mesh mesh;
  mesh.vertices_m = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {9, 9, 9}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}};
  return mesh;
}

TEST(VertexNormals, AreTheMeanOfTheirTrianglesByArea) {
  const auto normals = vertex_normals(folded_sheet());
  ASSERT_EQ(normals.size(), 6U);
  EXPECT_EQ(normals[1], (Vec3{0, 0, 1}));
  EXPECT_EQ(normals[4], (Vec3{1, 0, 0}));
  EXPECT_LT(norm(normals[0] - unit({1, 0, 2})), 1e-15);
  EXPECT_LT(norm(normals[3] - unit({1, 0, 1})), 1e-15);
}

TEST(VertexNormals, PointUpWhereNoTriangleDeterminesThem) {
  EXPECT_EQ(vertex_normals(folded_sheet())[5], (Vec3{0, 0, 1}));
}

TEST(Mesh, IsWatertightOnlyIfEveryEdgeHasTwoTriangles) {
  EXPECT_FALSE(is_watertight(folded_sheet()));
  Mesh tetrahedron{
      {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}, {}};
  EXPECT_TRUE(is_watertight(tetrahedron));
  std::swap(tetrahedron.triangles[0][1], tetrahedron.triangles[0][2]);
  EXPECT_FALSE(is_watertight(tetrahedron)) << "one triangle is turned over";
}

}  // namespace
}  // namespace palpable
