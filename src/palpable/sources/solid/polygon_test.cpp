// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/solid/polygon.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

Triangles cut(const std::vector<Vec3>& vertices) {
  std::vector<std::uint32_t> corners(vertices.size());
  std::iota(corners.begin(), corners.end(), 0U);
  Triangles triangles;
  append_triangles(vertices, corners, triangles);
  return triangles;
}

/// Signed area in the plane z = 0. It equals the sum of the areas of the parts if no part is reversed.
double area(const std::vector<Vec3>& vertices, const Triangles& triangles) {
  double sum = 0.0;
  for (const auto& t : triangles) {
    const double part = 0.5 * cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]).z;
    EXPECT_GE(part, 0.0) << "a triangle is turned over";
    sum += part;
  }
  return sum;
}

TEST(Polygon, CutsAQuadrilateralAtItsReflexCorner) {
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};
  const auto triangles = cut(arrow);
  ASSERT_EQ(triangles.size(), 2U);
  EXPECT_NEAR(area(arrow, triangles), 1.0, 1e-12);
}

TEST(Polygon, KeepsTheAreaOfAStarAndOfACircle) {
  std::vector<Vec3> star, circle;
  constexpr int kStarCorners = 40;
  for (int k = 0; k < kStarCorners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kStarCorners, radius = k % 2 == 0 ? 1.0 : 0.4;
    star.push_back({radius * std::cos(angle), radius * std::sin(angle), 0.0});
    circle.push_back({std::cos(angle), std::sin(angle), 0.0});
  }
  const double sector = std::sin(2.0 * std::numbers::pi / kStarCorners) / 2.0;
  EXPECT_EQ(cut(star).size(), star.size() - 2);
  EXPECT_NEAR(area(star, cut(star)), kStarCorners * 0.4 * sector, 1e-12);
  EXPECT_NEAR(area(circle, cut(circle)), kStarCorners * sector, 1e-12);
}

TEST(Polygon, EndsOnAFaceThatCrossesItself) {
  EXPECT_EQ(cut({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}, {0.5, 2, 0}}).size(), 3U);
  EXPECT_EQ(cut(std::vector<Vec3>(20)).size(), 18U);
}

}  // namespace
}  // namespace palpable::sources
