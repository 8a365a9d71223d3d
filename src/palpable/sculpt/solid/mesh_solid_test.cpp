// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/solid/mesh_solid.hpp"

#include "palpable/models/field/superquadric_mesh.hpp"
#include "palpable/sculpt/solid/surface_cut.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

TEST(MeshSolid, EstimatesTheMemoryOfAMeshBeforehand) {
  EXPECT_FALSE(mesh_too_large(100'000, std::size_t{1} << 30U));
  const auto refused = mesh_too_large(10'000'000, std::size_t{1} << 30U);
  ASSERT_TRUE(refused);
  EXPECT_NE(refused->message.find("MiB"), std::string::npos);
  EXPECT_NE(refused->message.find("triangles would fit"), std::string::npos);
}

TEST(MeshSolid, SaysHowManyTrianglesHaveAVertexThatIsNotFinite) {
  Mesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  mesh.vertices_m.push_back({0.0, std::numeric_limits<double>::quiet_NaN(), 0.0});
  mesh.triangles.push_back({0, 1, 8});
  mesh.triangles.push_back({1, 2, 8});
  mesh.triangles.push_back({1, 2, 2});
  const auto solid = solid_from_mesh(mesh, 0.01, {});
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.not_finite, 2U);
  EXPECT_EQ(solid->repair.degenerate, 1U);
  EXPECT_EQ(solid->repair.notes().front(),
            "2 triangles with a vertex that is not a finite number were left out.");
}

TEST(MeshSolid, TurnsAnInsideOutMesh) {
  Mesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  const auto solid = solid_from_mesh(mesh, 0.01, {});
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.turned_parts, 1U);
  DistanceSource::Hint hint;
  EXPECT_NEAR(solid->distance->at({0.2, 0.1, 0.5}, hint).distance_m, -0.5, 1e-9);
  EXPECT_NEAR(solid->distance->at({0, 0, 3}, hint).distance_m, 2.0, 1e-9);
}

TEST(MeshSolid, ClosesAnOpenMesh) {
  Mesh mesh = box_mesh({-1, -1, -1}, {1, 1, 1});
  mesh.triangles.resize(10);
  const auto solid = solid_from_mesh(mesh, 0.02, {});
  ASSERT_TRUE(solid);
  EXPECT_EQ(solid->repair.closed_holes, 1U);
  DistanceSource::Hint hint;
  EXPECT_NEAR(solid->distance->at({0.7, 0.1, 0.2}, hint).distance_m, -0.3, 1e-6);
  EXPECT_NEAR(solid->distance->at({1.5, 0.1, 0.2}, hint).distance_m, 0.5, 1e-6);
}

TEST(MeshSolid, SaysWhereAClosedHoleIsAndHowLarge) {
  // A court: walls and a floor of 40 x 20 x 30 mm, open above.
  Mesh mesh = box_mesh({-0.02, 0.0, -0.01}, {0.02, 0.02, 0.02});
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.vertices_m[v].y > 0.01; });
  });
  ASSERT_EQ(mesh.triangles.size(), 10U);
  const auto solid = solid_from_mesh(mesh, 0.0005, {});
  ASSERT_TRUE(solid);
  EXPECT_EQ(
      solid->repair.notes(),
      std::vector<std::string>{"One hole in the mesh was closed, and the space behind it is solid: 40 x 0 x "
                               "30 mm, its middle at (0, 20, 5) mm, faces up. So a vessel or a court "
                               "that is open above is filled to its rim, unless its walls and its floor also "
                               "have their inner sides."});
}

TEST(MeshSolid, ListsTheLargestOfManyClosedHoles) {
  MeshRepair repair;
  const std::vector<Vec3> places{{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}, {0, 0.001, 0}};
  const auto hole = [](std::uint32_t last) { return Hole{{}, {{0, 1, last}}}; };
  repair.add_closed(places, std::vector<Hole>{hole(3), hole(3), hole(2), hole(3), hole(3)});
  EXPECT_EQ(repair.closed_holes, 5U);
  ASSERT_EQ(repair.largest_holes.size(), 3U);
  EXPECT_DOUBLE_EQ(repair.largest_holes[0].area_m2, 5e-5);
  const std::string expected =
      "5 holes in the mesh were closed, and the spaces behind them are solid. The largest: 10 x 10 x 0 mm, "
      "its middle at (5, 5, 0) mm, faces to the front";
  EXPECT_EQ(repair.notes().front().substr(0, expected.size()), expected);
}

TEST(MeshSolid, ClosesHousesWithoutFloorsThatShareAWall) {
  const auto house = [](double from, double to) {
    Mesh mesh = box_mesh({from, 0, 0}, {to, 1, 1});
    mesh.triangles.erase(mesh.triangles.begin(), mesh.triangles.begin() + 2);
    return mesh;
  };
  const auto solid = solid_from_mesh(together(house(0, 1), house(1, 2)), 0.02, {});
  ASSERT_TRUE(solid);
  EXPECT_GE(solid->repair.closed_holes, 1U);
  DistanceSource::Hint hint;
  for (const double x : {0.5, 0.98, 1.02, 1.5}) {
    EXPECT_NEAR(solid->distance->at({x, 0.5, -0.3}, hint).distance_m, 0.3, 1e-3) << x;
    EXPECT_NEAR(solid->distance->at({x, 0.5, 0.1}, hint).distance_m, -0.1, 1e-3) << x;
    EXPECT_NEAR(solid->distance->at({x, 0.5, 0.8}, hint).distance_m, -0.2, 1e-3) << x;
  }
}

TEST(MeshSolid, JoinsBodiesThatOverlap) {
  const Vec3 slab_low{-1, -1, -1}, slab_high{1, 1, 0}, tower_low{-0.4, -0.4, -0.5}, tower_high{0.4, 0.4, 1};
  const auto solid =
      solid_from_mesh(together(box_mesh(slab_low, slab_high), box_mesh(tower_low, tower_high)), 0.04, {});
  ASSERT_TRUE(solid);
  EXPECT_GT(solid->repair.inner, 0U);
  DistanceSource::Hint hint;
  // On the covered top face of the slab, the nearest surface point is at the foot of the tower.
  EXPECT_NEAR(solid->distance->at({0, 0, -0.01}, hint).distance_m, -std::hypot(0.4, 0.01), 1e-6);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p{uniform(random), uniform(random), uniform(random)};
    const double to_slab = box_distance(p, slab_low, slab_high),
                 to_tower = box_distance(p, tower_low, tower_high);
    const double distance = solid->distance->at(p, hint).distance_m;
    // Outside: the smaller of both distances. The sign is correct everywhere, also at intersections and
    // seams.
    if (std::min(to_slab, to_tower) > 0.0)
      ASSERT_NEAR(distance, std::min(to_slab, to_tower), 1e-3) << p.x << " " << p.y << " " << p.z;
    else
      ASSERT_LE(distance, std::min(to_slab, to_tower) + 1e-9) << p.x << " " << p.y << " " << p.z;
  }
}

TEST(MeshSolid, CutsCrossedTrianglesIntoFewPieces) {
  Mesh city = box_mesh({-1, -1, -0.1}, {1, 1, 0});
  for (int i = 0; i < 16; ++i) {
    const double x = -0.9 + 0.45 * (i % 4), y = -0.9 + 0.45 * (i / 4);
    city = together(city, box_mesh({x, y, -0.02}, {x + 0.3, y + 0.3, 0.3}));
  }
  const TriangleTree tree(city);
  const SolidSurface surface = surface_of(city, tree, 0.004, {});
  // Divided into pieces of 4 mm, the top of the slab alone would be a hundred thousand triangles.
  EXPECT_LT(surface.mesh.triangles.size(), 2500U);
  double area_m2 = 0.0;
  for (const auto& t : surface.mesh.triangles) {
    const Vec3 a = surface.mesh.vertices_m[t[0]];
    area_m2 += 0.5 * norm(cross(surface.mesh.vertices_m[t[1]] - a, surface.mesh.vertices_m[t[2]] - a));
  }
  // Top and bottom, the slab's sides, and the towers' sides above the slab.
  EXPECT_NEAR(area_m2, 2.0 * 4.0 + 4.0 * 2.0 * 0.1 + 16.0 * 4.0 * 0.3 * 0.3, 1e-6);
}

TEST(MeshSolid, GainsNoSolidWhereItClosesAWindingRim) {
  // A U without a floor, with its lower ends at different heights. Its notch is outside; a triangle fan
  // around the middle of its rim would fill a part of the notch.
  const std::array<Vec3, 8> outline{{{0, 0, 0},
                                     {3, 0, 0.3},
                                     {3, 3, 0},
                                     {2.8, 3, 0.2},
                                     {2.8, 0.2, 0},
                                     {0.2, 0.2, 0.3},
                                     {0.2, 3, 0},
                                     {0, 3, 0.2}}};
  Mesh mesh;
  for (const Vec3 p : outline) mesh.vertices_m.push_back(p);
  for (const Vec3 p : outline) mesh.vertices_m.push_back({p.x, p.y, 1.0});
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t next = (i + 1) % 8;
    mesh.triangles.push_back({i, next, 8 + next});
    mesh.triangles.push_back({i, 8 + next, 8 + i});
  }
  const auto solid = solid_from_mesh(mesh, 0.006, {});
  ASSERT_TRUE(solid) << solid.error().sentence();
  EXPECT_EQ(solid->repair.closed_holes, 2U);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> x(0.3, 2.7), y(0.3, 2.9), z(-0.5, 1.5);
  DistanceSource::Hint hint;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p{x(random), y(random), z(random)};
    ASSERT_GT(solid->distance->at(p, hint).distance_m, 0.099) << p.x << " " << p.y << " " << p.z;
  }
  for (const double side : {0.1, 2.9})
    EXPECT_NEAR(solid->distance->at({side, 1.5, 0.6}, hint).distance_m, -0.1, 1e-3);
}

TEST(MeshSolid, FillsNoSpaceOutsideAScannedBunny) {
  const char* data = std::getenv("PALPABLE_DATA");
  if (data == nullptr) GTEST_SKIP() << "PALPABLE_DATA is not set";
  std::ifstream file(std::filesystem::path(data) / "mesh/objects/stanford-bunny.obj");
  if (!file) GTEST_SKIP() << "the bunny is not there";
  Mesh mesh;
  for (std::string line; std::getline(file, line);) {
    std::istringstream words(line);
    std::string kind;
    words >> kind;
    if (kind == "v")
      words >> mesh.vertices_m.emplace_back().x >> mesh.vertices_m.back().y >> mesh.vertices_m.back().z;
    if (kind != "f") continue;
    auto& t = mesh.triangles.emplace_back();
    for (std::uint32_t& v : t) {
      std::string corner;
      words >> corner;
      v = static_cast<std::uint32_t>(std::stoul(corner)) - 1;
    }
  }
  const Box box = bounds_of(mesh);
  const Vec3 size = box.size_m(), middle = 0.5 * (box.least_m + box.most_m);
  for (Vec3& v : mesh.vertices_m) v = 0.1 / std::max({size.x, size.y, size.z}) * (v - middle);
  const auto solid = solid_from_mesh(mesh, 0.1 / 512, {});
  ASSERT_TRUE(solid) << solid.error().sentence();
  EXPECT_EQ(solid->repair.closed_holes, 5U);
  EXPECT_EQ(solid->repair.inner, 0U);
  DistanceSource::Hint hint;
  // 1 mm below its lowest point.
  EXPECT_NEAR(solid->distance->at({0.008217, -0.050654, 0.025594}, hint).distance_m, 0.0027, 2e-4);
}

TEST(MeshSolid, KeepsStripsOfSmallFacetsThatOthersCover) {
  // A wall of facets of 1 mm, half of its last column covered by a second body; the finest cells are 2 mm.
  constexpr int kFacets = 10;
  constexpr double kSide = 0.01, kCovered = 0.0046;
  Mesh wall = box_mesh({0, 0, 0}, {kSide, kSide, 0.002});
  std::erase_if(wall.triangles, [&](const auto& t) {
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return wall.vertices_m[v].z == 0.002; });
  });
  for (int row = 0; row < kFacets; ++row)
    for (int column = 0; column < kFacets; ++column) {
      const auto first = static_cast<std::uint32_t>(wall.vertices_m.size());
      const double step = kSide / kFacets;
      for (const int corner : {0, 1, 2, 3})
        wall.vertices_m.push_back({step * (column + corner % 2), step * (row + corner / 2), 0.002});
      wall.triangles.push_back({first, first + 1, first + 3});
      wall.triangles.push_back({first, first + 3, first + 2});
    }
  const Mesh mesh = together(wall, box_mesh({-0.001, -0.001, 0.001}, {kCovered, kSide + 0.001, 0.004}));
  const TriangleTree tree(mesh);
  const SolidSurface surface = surface_of(mesh, tree, 0.002, {});
  double top_m2 = 0.0;
  for (const auto& t : surface.mesh.triangles) {
    const Vec3 a = surface.mesh.vertices_m[t[0]];
    const Vec3 area = 0.5 * cross(surface.mesh.vertices_m[t[1]] - a, surface.mesh.vertices_m[t[2]] - a);
    if (std::abs(a.z - 0.002) < 1e-9 && area.z > 0.99 * norm(area)) top_m2 += area.z;
  }
  EXPECT_NEAR(top_m2, (kSide - kCovered) * kSide, 1e-10);
}

TEST(MeshSolid, DeterminesTheSideOfAThinPlateFromFarAway) {
  constexpr double kThickness = 4e-6;
  const Vec3 low{-0.05, -0.05, 0}, high{0.05, 0.05, kThickness};
  const auto solid = solid_from_mesh(box_mesh(low, high), 2e-4, {});
  ASSERT_TRUE(solid) << solid.error().sentence();
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> uniform(-0.06, 0.06);
  DistanceSource::Hint hint;
  for (int i = 0; i < 5000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p{x, y, z};
    const double truth_m = box_distance(p, low, high);
    ASSERT_NEAR(solid->distance->at(p, hint).distance_m, truth_m, 1e-5 + 1e-3 * std::abs(truth_m));
  }
}

TEST(MeshSolid, ReplacesSmallFacetsByTheSmoothSurfaceThatTheyApproximate) {
  models::Superquadric ball;
  ball.size_m = {0.02, 0.02, 0.02};
  const Mesh mesh = models::mesh_of(ball, 0.001);
  constexpr double kFinest_m = 0.0005, kRounding_m = 2e-5;
  const auto rounded = solid_from_mesh(mesh, kFinest_m, {}, {.rounding_m = kRounding_m});
  const auto exact = solid_from_mesh(mesh, kFinest_m, {});
  ASSERT_TRUE(rounded && exact);
  EXPECT_EQ(rounded->repair.rounded, mesh.triangles.size());
  EXPECT_FALSE(rounded->repair.notes().empty());
  EXPECT_EQ(exact->repair.rounded, 0U);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> uniform(-0.024, 0.024);
  DistanceSource::Hint hint, other;
  double facets_m = 0.0;
  for (int i = 0; i < 5000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p{x, y, z};
    if (norm(p) < 0.01) continue;
    const double distance_m = rounded->distance->at(p, hint).distance_m;
    const double of_facets_m = exact->distance->at(p, other).distance_m;
    ASSERT_NEAR(distance_m, norm(p) - 0.02, 1e-6);
    ASSERT_NEAR(distance_m, of_facets_m, kRounding_m);
    facets_m = std::max(facets_m, std::abs(of_facets_m - (norm(p) - 0.02)));
  }
  EXPECT_GT(facets_m, 3e-6);
}

TEST(MeshSolid, KeepsFacetsThatAreLargeOrFarFromASmoothSurface) {
  models::Superquadric ball;
  ball.size_m = {0.02, 0.02, 0.02};
  const Mesh mesh = models::mesh_of(ball, 0.001);
  const auto exact = solid_from_mesh(mesh, 0.0005, {});
  const auto too_far = solid_from_mesh(mesh, 0.0005, {}, {.rounding_m = 1e-6});
  const auto too_large = solid_from_mesh(mesh, 0.00005, {}, {.rounding_m = 2e-5});
  ASSERT_TRUE(exact && too_far && too_large);
  std::mt19937_64 random(8);
  std::uniform_real_distribution<double> uniform(-0.024, 0.024);
  DistanceSource::Hint hint, first, second;
  for (int i = 0; i < 2000; ++i) {
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    const Vec3 p{x, y, z};
    const double distance_m = exact->distance->at(p, hint).distance_m;
    const double slack_m = 2.0 * TriangleTree::kNearestSlack * std::abs(distance_m);
    ASSERT_NEAR(too_far->distance->at(p, first).distance_m, distance_m, 1e-6 + slack_m);
    ASSERT_NEAR(too_large->distance->at(p, second).distance_m, distance_m, 1e-9 + slack_m);
  }
}

TEST(MeshSolid, RefusesMeshesWithoutASolid) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(solid_from_mesh({}, 0.01, {}));
  Mesh nan;
  nan.vertices_m = {{0, 0, 0}, {1, 0, 0}, {kNaN, 1, 0}};
  nan.triangles = {{0, 1, 2}, {0, 1, 7}, {0, 1, 1}};
  EXPECT_FALSE(solid_from_mesh(nan, 0.01, {}));
  Mesh single;
  single.vertices_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  single.triangles = {{0, 1, 2}};
  EXPECT_FALSE(solid_from_mesh(single, 0.01, {}));
}

}  // namespace
}  // namespace palpable::sculpt
