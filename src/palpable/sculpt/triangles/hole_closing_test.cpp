// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/hole_closing.hpp"

#include "palpable/sculpt/solid/test_solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

struct Lid {
  double area_m2 = 0.0;
  /// The vector sum of the areas of the triangles.
  Vec3 area_vector_m2;
};
Lid lid_of(const Mesh& mesh, std::size_t first) {
  Lid lid;
  for (std::size_t i = first; i < mesh.triangles.size(); ++i) {
    const auto& t = mesh.triangles[i];
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 area = 0.5 * cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    lid.area_m2 += norm(area);
    lid.area_vector_m2 += area;
  }
  return lid;
}

/// Walls of height 1 over a closed outline, counter-clockwise seen from above; no floor and no roof.
Mesh walls_over(std::span<const Vec3> outline) {
  Mesh mesh;
  const auto count = static_cast<std::uint32_t>(outline.size());
  for (const double height : {0.0, 1.0})
    for (const Vec3 p : outline) mesh.vertices_m.push_back({p.x, p.y, p.z + height});
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({i, next, count + next});
    mesh.triangles.push_back({i, count + next, count + i});
  }
  return mesh;
}

/// A U; the mean of its corners lies in the notch.
constexpr std::array<Vec3, 8> kU{
    {{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {2.8, 3, 0}, {2.8, 0.2, 0}, {0.2, 0.2, 0}, {0.2, 3, 0}, {0, 3, 0}}};
constexpr double kAreaOfU = 3.0 * 3.0 - 2.6 * 2.8;

TEST(HoleClosing, ClosesAFlatRimThatIsNotConvexByAFlatLidWithoutAFold) {
  Mesh mesh = walls_over(kU);
  const std::size_t before = mesh.triangles.size();
  EXPECT_EQ(close_holes(mesh), 2U);
  EXPECT_TRUE(is_watertight(mesh));
  const Lid lid = lid_of(mesh, before);
  EXPECT_NEAR(lid.area_m2, 2.0 * kAreaOfU, 1e-9);
  // Floor and roof face in opposite directions.
  EXPECT_NEAR(norm(lid.area_vector_m2), 0.0, 1e-9);
}

TEST(HoleClosing, BendsNoMoreThanTheSurfaceAround) {
  // Half of the cap of a ball is missing: the triangles of the lid meet each other and the rim at small
  // angles.
  constexpr int kPlaces = 40;
  std::vector<Vec3> rim, normals;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPlaces;
    const double polar = 0.5 + (i % 2 == 0 ? 0.06 : 0.0);
    rim.push_back({std::sin(polar) * std::cos(angle), std::sin(polar) * std::sin(angle), std::cos(polar)});
    // The surface is traversed along its rim with the hole on the right.
    normals.push_back(rim.back());
  }
  std::reverse(rim.begin(), rim.end());
  std::reverse(normals.begin(), normals.end());
  Mesh mesh;
  mesh.vertices_m = rim;
  mesh.triangles = triangulated_hole(rim, normals);
  ASSERT_EQ(mesh.triangles.size(), static_cast<std::size_t>(kPlaces - 2));
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 n = unit(cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a));
    EXPECT_GT(n.z, 0.5);
  }
}

TEST(HoleClosing, DividesARimOfManyVertices) {
  constexpr int kPlaces = 1500;
  std::vector<Vec3> circle;
  for (int i = 0; i < kPlaces; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / kPlaces;
    circle.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  Mesh mesh = walls_over(circle);
  const std::size_t before = mesh.triangles.size();
  EXPECT_EQ(close_holes(mesh), 2U);
  EXPECT_TRUE(is_watertight(mesh));
  EXPECT_NEAR(lid_of(mesh, before).area_m2, 2.0 * std::numbers::pi, 1e-3);
}

TEST(HoleClosing, DoesNotCountASlitWithoutAnAreaAsAHole) {
  // A box; one of its triangles is divided at the middle of an edge, the neighbouring triangle is not.
  Mesh mesh = box_mesh({0, 0, 0}, {1, 1, 1});
  const auto divided = mesh.triangles.back();
  const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
  mesh.vertices_m.push_back(0.5 * (mesh.vertices_m[divided[0]] + mesh.vertices_m[divided[1]]));
  mesh.triangles.back() = {divided[0], middle, divided[2]};
  mesh.triangles.push_back({middle, divided[1], divided[2]});
  const std::size_t before = mesh.triangles.size();
  EXPECT_EQ(close_holes(mesh), 0U);
  EXPECT_EQ(mesh.triangles.size(), before);
}

}  // namespace
}  // namespace palpable::sculpt
