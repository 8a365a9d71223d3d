// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/small_parts.hpp"

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

// A tetrahedron with sides of this length along the axes.
void add_tetrahedron(Mesh& to, Vec3 at, double side_m) {
  const auto first = static_cast<std::uint32_t>(to.vertices_m.size());
  for (const Vec3& corner : {Vec3{0, 0, 0}, Vec3{side_m, 0, 0}, Vec3{0, side_m, 0}, Vec3{0, 0, side_m}})
    to.vertices_m.push_back(at + corner);
  for (const auto& t : {std::array<std::uint32_t, 3>{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}})
    to.triangles.push_back({first + t[0], first + t[1], first + t[2]});
}

TEST(SmallParts, AreLeftOutAndTheRestStaysInOrder) {
  Mesh mesh;
  add_tetrahedron(mesh, {0.5, 0, 0}, 0.01);
  add_tetrahedron(mesh, {0, 0, 0}, 1.0);
  add_tetrahedron(mesh, {0.1, 0.1, 0.1}, 0.04);
  add_tetrahedron(mesh, {0.5, 0.5, 0.9}, 0.06);
  const Mesh left = without_small_parts(mesh, 0.05);
  ASSERT_EQ(left.triangles.size(), 8U);
  ASSERT_EQ(left.vertices_m.size(), 8U);
  EXPECT_TRUE(is_watertight(left));
  EXPECT_EQ(left.vertices_m[left.triangles[0][0]], mesh.vertices_m[4]);
  EXPECT_EQ(left.vertices_m[left.triangles[7][2]], mesh.vertices_m[15]);
  EXPECT_EQ(without_small_parts(mesh, 0.0).triangles.size(), mesh.triangles.size());
  EXPECT_TRUE(without_small_parts({}, 0.05).triangles.empty());
}

}  // namespace
}  // namespace palpable::sculpt
