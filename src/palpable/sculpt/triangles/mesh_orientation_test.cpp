// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/mesh_orientation.hpp"

#include "palpable/sculpt/solid/test_solids.hpp"
#include "palpable/sculpt/triangles/hole_closing.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kSide_m = 0.01;

/// A house that begins at x = `at`, as in city models: walls and roof, no floor.
Mesh open_house(double at_m) {
  Mesh house = box_mesh({at_m, 0.0, 0.0}, {at_m + kSide_m, kSide_m, kSide_m});
  std::erase_if(house.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return house.vertices_m[v].z == 0.0; });
  });
  return house;
}

TEST(MeshOrientation, OrientsWallsSharedByHousesByTheirEdges) {
  constexpr int kHouses = 5;
  Mesh row = open_house(0.0);
  for (int k = 1; k < kHouses; ++k) row = together(row, open_house(kSide_m * k));
  // Rays give no information about a shared wall, so the random choice would leave some of them reversed.
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    std::size_t removed = 0;
    Mesh mesh = welded(row, removed);
    for (std::size_t t = seed % 3; t < mesh.triangles.size(); t += 3)
      std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
    orient_outwards(mesh, seed);
    EXPECT_EQ(close_holes(mesh), 1U);
    const TriangleTree tree(mesh);
    for (int k = 0; k < kHouses; ++k)
      EXPECT_NEAR(tree.winding({kSide_m * (k + 0.4), 0.4 * kSide_m, 0.4 * kSide_m}), 1.0, 0.02)
          << "house " << k << " with seed " << seed;
    EXPECT_NEAR(tree.winding({kSide_m * 2.4, 0.4 * kSide_m, 1.1 * kSide_m}), 0.0, 0.02);
  }
}

TEST(MeshOrientation, TurnsOverlappingBodiesOutwardsAndKeepsCavities) {
  // Four fifths of the small box are in the large one, where rays from it cross an even number of walls.
  const Mesh large = box_mesh({0.0, 0.0, 0.0}, {0.02, 0.02, 0.02});
  Mesh small = box_mesh({0.0121, 0.005, 0.005}, {0.0221, 0.015, 0.015});
  Mesh cavity = box_mesh({0.004, 0.004, 0.004}, {0.006, 0.006, 0.006});
  for (auto& t : cavity.triangles) std::swap(t[1], t[2]);
  for (const bool reversed : {false, true}) {
    for (auto& t : small.triangles)
      if (reversed) std::swap(t[1], t[2]);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      Mesh mesh = together(together(large, small), cavity);
      EXPECT_EQ(orient_outwards(mesh, seed), reversed ? 1U : 0U) << seed;
      const TriangleTree tree(mesh);
      EXPECT_NEAR(tree.winding({0.021, 0.01, 0.01}), 1.0, 0.02) << seed;
      EXPECT_NEAR(tree.winding({0.015, 0.01, 0.01}), 2.0, 0.02) << seed;
      EXPECT_NEAR(tree.winding({0.005, 0.005, 0.005}), 0.0, 0.02) << seed;
    }
  }
}

TEST(MeshOrientation, TurnsPartsThatAreInsideOutOnceTheyAreClosed) {
  Mesh turned = box_mesh({0.02, 0.0, 0.0}, {0.03, 0.01, 0.01});
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  Mesh mesh = together(box_mesh({0.0, 0.0, 0.0}, {0.01, 0.01, 0.01}), turned);
  // The faces of a cavity correctly point inwards.
  Mesh hollow = box_mesh({0.004, 0.004, 0.004}, {0.006, 0.006, 0.006});
  for (auto& t : hollow.triangles) std::swap(t[1], t[2]);
  mesh = together(mesh, hollow);
  const TriangleTree before(mesh);
  EXPECT_NEAR(before.winding({0.025, 0.005, 0.005}), -1.0, 0.02);
  EXPECT_EQ(turn_inside_out_parts(mesh, before), 1U);
  const TriangleTree after(mesh);
  EXPECT_NEAR(after.winding({0.025, 0.005, 0.005}), 1.0, 0.02);
  EXPECT_NEAR(after.winding({0.002, 0.005, 0.005}), 1.0, 0.02);
  EXPECT_NEAR(after.winding({0.005, 0.005, 0.005}), 0.0, 0.02);
  EXPECT_EQ(turn_inside_out_parts(mesh, after), 0U);
}

}  // namespace
}  // namespace palpable::sculpt
