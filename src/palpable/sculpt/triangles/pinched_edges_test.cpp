// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/pinched_edges.hpp"

#include "palpable/sculpt/triangles/touching_towers.hpp"

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

double volume_of(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += dot(mesh.vertices_m[t[0]], cross(mesh.vertices_m[t[1]], mesh.vertices_m[t[2]])) / 6;
  return sum;
}

TEST(PinchedEdges, SeparatesBoxesThatTouchAlongAnEdge) {
  Mesh mesh;
  add_joined_box({0, 0, 0}, {1, 1, 1}, mesh);
  add_joined_box({1, 1, 0}, {2, 2, 1}, mesh);
  ASSERT_EQ(mesh.vertices_m.size(), 14U);
  ASSERT_FALSE(is_watertight(mesh));
  const Mesh divided = with_pinches_divided(mesh);
  EXPECT_TRUE(is_watertight(divided));
  // Each box keeps its own eight corners: triangles of the same solid stay connected.
  EXPECT_EQ(divided.vertices_m.size(), 16U);
  EXPECT_NEAR(volume_of(divided), 2.0, 1e-12);
}

TEST(PinchedEdges, ClosesSheetsThatAreConnectedAroundTheEndsOfAnEdge) {
  const Mesh solid = touching_towers();
  ASSERT_FALSE(is_watertight(solid));
  const Mesh divided = with_pinches_divided(solid);
  EXPECT_TRUE(is_watertight(divided));
  EXPECT_NEAR(volume_of(divided), 10.0, 1e-12);
}

TEST(PinchedEdges, LeavesAClosedMeshAsItIs) {
  Mesh mesh;
  add_joined_box({0, 0, 0}, {1, 2, 3}, mesh);
  const Mesh divided = with_pinches_divided(mesh);
  EXPECT_TRUE(is_watertight(divided));
  EXPECT_EQ(divided.vertices_m.size(), 8U);
}

}  // namespace
}  // namespace palpable::sculpt
