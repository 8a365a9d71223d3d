// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/pinched_edges.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

// Adds a box whose corners are shared with equal ones of the mesh.
void add_box(Vec3 least, Vec3 most, Mesh& mesh) {
  std::array<std::uint32_t, 8> at{};
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 p{(i & 1U) != 0 ? most.x : least.x, (i & 2U) != 0 ? most.y : least.y,
                 (i & 4U) != 0 ? most.z : least.z};
    at[i] = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (std::uint32_t k = 0; k < mesh.vertices_m.size(); ++k)
      if (mesh.vertices_m[k] == p) at[i] = k;
    if (at[i] == mesh.vertices_m.size()) mesh.vertices_m.push_back(p);
  }
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({at[f[0]], at[f[1]], at[f[2]]});
    mesh.triangles.push_back({at[f[0]], at[f[2]], at[f[3]]});
  }
}

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(mesh.vertices_m[t[0]], cross(mesh.vertices_m[t[1]], mesh.vertices_m[t[2]])) / 6;
  return sum;
}

TEST(PinchedEdges, SeparatesBoxesThatTouchAlongAnEdge) {
  Mesh mesh;
  add_box({0, 0, 0}, {1, 1, 1}, mesh);
  add_box({1, 1, 0}, {2, 2, 1}, mesh);
  ASSERT_EQ(mesh.vertices_m.size(), 14U);
  ASSERT_FALSE(is_watertight(mesh));
  const Mesh divided = with_pinches_divided(mesh);
  EXPECT_TRUE(is_watertight(divided));
  // Each box keeps its own eight corners: triangles of the same solid stay connected.
  EXPECT_EQ(divided.vertices_m.size(), 16U);
  EXPECT_NEAR(volume_of(divided), 2.0, 1e-12);
}

TEST(PinchedEdges, LeavesAClosedMeshAsItIs) {
  Mesh mesh;
  add_box({0, 0, 0}, {1, 2, 3}, mesh);
  const Mesh divided = with_pinches_divided(mesh);
  EXPECT_TRUE(is_watertight(divided));
  EXPECT_EQ(divided.vertices_m.size(), 8U);
}

}  // namespace
}  // namespace palpable::sculpt
