// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/triangles/near_rims.hpp"

#include <array>
#include <cstdint>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// A box of 0.1 m whose twelve triangles have corners of their own, moved at random by about `by_m`.
Mesh loose_box(double by_m, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> noise(0.0, by_m);
  Mesh mesh;
  for (const std::array<int, 3>& t : {std::array{0, 2, 3},
                                      {0, 3, 1},
                                      {4, 5, 7},
                                      {4, 7, 6},
                                      {0, 1, 5},
                                      {0, 5, 4},
                                      {2, 6, 7},
                                      {2, 7, 3},
                                      {0, 4, 6},
                                      {0, 6, 2},
                                      {1, 3, 7},
                                      {1, 7, 5}}) {
    std::array<std::uint32_t, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      triangle[k] = static_cast<std::uint32_t>(mesh.vertices_m.size());
      const Vec3 corner{0.1 * (t[k] & 1), 0.1 * (t[k] >> 1 & 1), 0.1 * (t[k] >> 2 & 1)};
      mesh.vertices_m.push_back(corner + Vec3{noise(random), noise(random), noise(random)});
    }
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TEST(LooseTriangles, AreASolidIfTheirCornersDifferOnlyInTheLastDigits) {
  for (const double by_m : {1e-12, 1e-10, 1e-9, 3e-9, 1e-8, 2e-8})
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
      const auto solid = solid_from_mesh(loose_box(by_m, seed), 1e-3, {});
      ASSERT_TRUE(solid) << by_m;
      EXPECT_EQ(solid->repair.open_sheets, 0U) << by_m;
      EXPECT_EQ(solid->repair.closed_holes, 0U) << by_m;
      DistanceSource::Hint hint;
      EXPECT_NEAR(solid->distance->at({0.05, 0.05, 0.06}, hint).distance_m, -0.04, 1e-6) << by_m;
      EXPECT_NEAR(solid->distance->at({0.05, 0.05, 0.12}, hint).distance_m, 0.02, 1e-6) << by_m;
    }
}

TEST(LooseTriangles, FartherAwayStayApart) {
  Mesh mesh = loose_box(0.0, 1);
  mesh.vertices_m[0].z -= 1e-6;
  const auto before = mesh.triangles;
  join_near_rims(mesh, 1.7e-7);
  EXPECT_EQ(mesh.triangles[0][0], before[0][0]);
}

}  // namespace
}  // namespace palpable::sculpt
