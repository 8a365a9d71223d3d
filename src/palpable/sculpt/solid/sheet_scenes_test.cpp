// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Random scenes of closed bodies, bodies with holes, and open sheets of many shapes: both sides of a sheet
// are air, bodies are solid. `--gtest_random_seed=N` makes other scenes.
#include "palpable/sculpt/solid/sheet_scenes.hpp"

#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// The greatest errors of 50 random scenes.
void expect_true_solids(SheetScene (SceneMaker::*make)(), double within_m) {
  const auto seed = 20261122U + 1000U * static_cast<unsigned>(GTEST_FLAG_GET(random_seed));
  std::mt19937_64 random(seed);
  constexpr unsigned kScenes = 50;
  for (unsigned k = 0; k < kScenes; ++k) {
    SceneMaker maker(seed + k);
    SheetScene scene = (maker.*make)();
    // Files store single precision.
    if (k % 2 == 1)
      for (Vec3& v : scene.mesh.vertices_m)
        v = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    const auto solid = solid_from_mesh(scene.mesh, kCell_m, {}, {}, kTwoCellWalls);
    ASSERT_TRUE(solid) << seed + k << ": " << scene.words;
    const WorstPlace worst = worst_place(scene, *solid, random);
    EXPECT_LT(worst.error_m, within_m)
        << seed + k << ": " << scene.words << (worst.is_solid ? "solid" : "air") << " at " << worst.place_m.x
        << " " << worst.place_m.y << " " << worst.place_m.z;
  }
}

TEST(SheetScenes, HaveAirOnBothSidesOfSheetsAndSolidBodies) { expect_true_solids(&SceneMaker::scene, 2e-6); }

TEST(SheetScenes, HaveTheSameSolidsWithTrianglesOfBothOrientations) {
  expect_true_solids(&SceneMaker::double_sided_scene, 2e-6);
}

TEST(SheetScenes, SayWhatWasAssumedOfTrianglesWithBothOrientations) {
  const auto both_sides = [](Mesh mesh) {
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i) {
      const auto t = mesh.triangles[i];
      mesh.triangles.push_back({t[0], t[2], t[1]});
    }
    return mesh;
  };
  const Mesh outer = both_sides(box_mesh({-0.02, -0.02, 0.0}, {0.02, 0.02, 0.04})),
             inner = both_sides(box_mesh({-0.01, -0.01, 0.01}, {0.01, 0.01, 0.03}));
  const Mesh screen = both_sides(grid_sheet(1, 16, [](double u, double v) {
    return Vec3{0.03 * std::cos(3.0 * v) + 0.07, 0.04 * u, 0.03 * std::sin(3.0 * v)};
  }));
  const auto body = solid_from_mesh(outer, kCell_m, {});
  ASSERT_TRUE(body);
  EXPECT_EQ(body->repair.notes(),
            std::vector<std::string>{"12 triangles occur with both orientations (double-sided) and were used "
                                     "once: one closed surface was filled."});
  DistanceSource::Hint hint;
  EXPECT_NEAR(body->distance->at({0.0, 0.0, 0.015}, hint).distance_m, -0.015, 1e-6);
  const auto scene =
      solid_from_mesh(together(together(outer, inner), screen), kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(scene);
  EXPECT_EQ(
      scene->repair.notes(),
      (std::vector<std::string>{
          "56 triangles occur with both orientations (double-sided) and were used once: 2 closed surfaces "
          "were filled, one open surface is a sheet. Of the filled ones 1 lies in another body: "
          "double-sided triangles do not say whether that is a cavity.",
          "12 triangles inside the solid were left out.",
          "One open sheet, with air on both sides, was given a thickness of 0.4 mm."}));
  DistanceSource::Hint other;
  EXPECT_LT(scene->distance->at({0.0, 0.0, 0.02}, other).distance_m, -0.019);
}

TEST(SheetScenes, WithstandTrianglesThatAreNearlyLinesBesideRims) {
  // The third vertex of a sliver lies on its longest side, which is a rim of a second sheet too.
  Mesh mesh = box_mesh({-0.02, -0.02, 0.0}, {0.02, 0.02, 0.02});
  Mesh slivers;
  slivers.vertices_m = {
      {0.03, 0.0, 0.0}, {0.05, 0.0, 0.0}, {0.04, 1e-10, 0.0}, {0.04, 0.02, 0.0}, {0.04, 0.0, 0.02}};
  slivers.triangles = {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}};
  EXPECT_TRUE(solid_from_mesh(together(mesh, slivers), kCell_m, {}, {}, kTwoCellWalls));
}

TEST(SheetScenes, SayWhatBecameOfSheets) {
  // A floor and a wall that share an edge, and a cube on them.
  const Mesh stage = together(grid_sheet(1, 1,
                                         [](double u, double v) {
                                           return Vec3{0.08 * u - 0.04, 0.08 * v - 0.04, 0.0};
                                         }),
                              grid_sheet(1, 1, [](double u, double v) {
                                return Vec3{0.08 * u - 0.04, 0.04, 0.06 * v};
                              }));
  const Mesh cube = box_mesh({-0.01, -0.01, 0.001}, {0.01, 0.01, 0.021});
  const auto solid = solid_from_mesh(together(cube, stage), kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.open_sheets, 1U);
  EXPECT_EQ(solid->repair.closed_holes, 0U);
  EXPECT_EQ(solid->repair.turned_parts, 0U);
  const std::vector<std::string> notes = solid->repair.notes();
  ASSERT_EQ(notes.size(), 1U);
  EXPECT_EQ(notes[0], "One open sheet, with air on both sides, was given a thickness of 0.4 mm.");
  DistanceSource::Hint hint;
  // 32 mm from everything.
  EXPECT_NEAR(solid->distance->at({0.0, -0.005, 0.055}, hint).distance_m, std::hypot(0.0, 0.034), 1e-4);
  EXPECT_NEAR(solid->distance->at({0.0, 0.0, 0.011}, hint).distance_m, -0.01, 1e-6);
  // Sheets alone are a solid too, but have no volume without a thickness.
  EXPECT_TRUE(solid_from_mesh(stage, kCell_m, {}, {}, kTwoCellWalls));
  EXPECT_FALSE(solid_from_mesh(stage, kCell_m, {}));
}

TEST(SheetScenes, FillAMouldingWhoseRimLiesOnAWall) {
  // A ledge in front of a box and around its sides, open at the back.
  const Vec3 low{-0.02, -0.015, 0.0}, high{0.02, 0.015, 0.04};
  const Mesh ledge_box = box_mesh({-0.023, -0.018, 0.02}, {0.023, -0.005, 0.026});
  Mesh ledge = ledge_box;
  std::erase_if(ledge.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return ledge.vertices_m[v].y == -0.005; });
  });
  // Half a tube on the box, its curved ends on two posts.
  const Mesh tube = grid_sheet(1, 16, [](double u, double v) {
    return Vec3{0.03 * u - 0.015, -0.006 * std::cos(v * std::numbers::pi),
                0.04 + 0.006 * std::sin(v * std::numbers::pi)};
  });
  Mesh mesh = together(together(box_mesh(low, high), ledge), tube);
  const Mesh posts = together(box_mesh({-0.018, -0.008, 0.035}, {-0.015, 0.008, 0.05}),
                              box_mesh({0.015, -0.008, 0.035}, {0.018, 0.008, 0.05}));
  const auto open_ends = solid_from_mesh(mesh, kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(open_ends);
  EXPECT_EQ(open_ends->repair.open_sheets, 1U);
  const auto solid = solid_from_mesh(together(mesh, posts), kCell_m, {}, {}, kTwoCellWalls);
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.open_sheets, 0U);
  DistanceSource::Hint hint;
  EXPECT_LT(solid->distance->at({0.0, 0.0, 0.043}, hint).distance_m, -0.0029);
  DistanceSource::Hint other;
  EXPECT_GT(open_ends->distance->at({0.0, 0.0, 0.043}, other).distance_m, 0.0);
  EXPECT_LT(solid->distance->at({0.0, -0.0165, 0.023}, hint).distance_m, -0.0014);
}

TEST(SheetScenes, KeepHousesWithoutAFloorAndMapsWithABaseClosed) {
  // Five faces of a hall of 100 x 50 x 10 mm.
  const Vec3 low{-0.05, -0.025, 0.0}, high{0.05, 0.025, 0.01};
  Mesh hall = box_mesh(low, high);
  std::erase_if(hall.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return hall.vertices_m[v].z == low.z; });
  });
  // A hilly map with a rim down to a base, which is missing.
  Mesh map = grid_sheet(20, 20, [](double u, double v) {
    const bool at_rim = u == 0.0 || v == 0.0 || u == 1.0 || v == 1.0;
    const auto inside = [](double a) { return std::clamp((a - 0.05) / 0.9, 0.0, 1.0); };
    return Vec3{0.1 * inside(u) - 0.05, 0.1 * inside(v) - 0.05,
                at_rim ? 0.0 : 0.004 + 0.003 * std::sin(12.0 * u) * std::sin(9.0 * v)};
  });
  for (const Mesh& mesh : {hall, map}) {
    const auto solid = solid_from_mesh(mesh, kCell_m, {}, {}, kTwoCellWalls);
    ASSERT_TRUE(solid);
    EXPECT_EQ(solid->repair.open_sheets, 0U);
    EXPECT_EQ(solid->repair.closed_holes, 1U);
    DistanceSource::Hint hint;
    EXPECT_LT(solid->distance->at({0.002, 0.003, 0.0005}, hint).distance_m, -0.0004);
  }
}

}  // namespace
}  // namespace palpable::sculpt
