// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_from_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// A square of side `side_m` about the origin in cells of two triangles each; z(x, y).
template <class Height>
Mesh sheet(double side_m, unsigned cells, Height z) {
  Mesh mesh;
  for (unsigned j = 0; j <= cells; ++j)
    for (unsigned i = 0; i <= cells; ++i) {
      const double x = side_m * (static_cast<double>(i) / cells - 0.5),
                   y = side_m * (static_cast<double>(j) / cells - 0.5);
      mesh.vertices_m.push_back({x, y, z(x, y)});
    }
  const auto at = [&](unsigned i, unsigned j) { return j * (cells + 1) + i; };
  for (unsigned j = 0; j < cells; ++j)
    for (unsigned i = 0; i < cells; ++i) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

Mesh add(Mesh a, const Mesh& b, Vec3 move) {
  const auto first = static_cast<std::uint32_t>(a.vertices_m.size());
  for (const Vec3 v : b.vertices_m) a.vertices_m.push_back(v + move);
  for (const auto& t : b.triangles) a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return a;
}

TEST(HeightsFromAbove, AreExactOnASlopeAndLeaveNoGapAlongSharedEdges) {
  const Mesh mesh = sheet(0.1, 7, [](double x, double y) { return 0.02 + 0.3 * x - 0.1 * y; });
  const auto heights = heights_from_above(mesh, -0.05, 0.05, 0.1 / 300, 300, 300, {});
  ASSERT_TRUE(heights);
  for (int j = 0; j < 300; ++j)
    for (int i = 0; i < 300; ++i) {
      const double x = -0.05 + (i + 0.5) * 0.1 / 300, y = 0.05 - (j + 0.5) * 0.1 / 300;
      ASSERT_NEAR((*heights)(i, j), 0.02 + 0.3 * x - 0.1 * y, 1e-8) << i << ' ' << j;
    }
}

TEST(HeightsFromAbove, AreThoseOfTheHighestSheetAndNoneBeside) {
  const auto level = [](double z) { return [z](double, double) { return z; }; };
  const Mesh mesh = add(sheet(0.08, 1, level(0.01)), sheet(0.02, 1, level(0.0)), {0.0, 0.0, 0.03});
  const auto heights = heights_from_above(mesh, -0.05, 0.05, 0.001, 100, 100, {});
  ASSERT_TRUE(heights);
  EXPECT_FLOAT_EQ((*heights)(50, 50), 0.03F);
  EXPECT_FLOAT_EQ((*heights)(30, 50), 0.01F);
  EXPECT_TRUE(std::isnan((*heights)(5, 50)));
}

TEST(HeightsFromAbove, AreTheSameForAnyNumberOfThreads) {
  const Mesh mesh = sheet(0.1, 9, [](double x, double y) { return 0.01 * std::sin(90.0 * x) * y; });
  const auto one = heights_from_above(mesh, -0.05, 0.05, 0.0005, 200, 200, Work{1, 0, {}, {}});
  const auto two = heights_from_above(mesh, -0.05, 0.05, 0.0005, 200, 200, Work{2, 0, {}, {}});
  ASSERT_TRUE(one && two);
  EXPECT_TRUE(std::ranges::equal(one->values(), two->values()));
}

TEST(OpenSheet, FacesMostlyOneWay) {
  EXPECT_TRUE(is_open_sheet(sheet(0.1, 2, [](double, double) { return 0.0; })));
  EXPECT_TRUE(
      is_open_sheet(sheet(100.0, 20, [](double x, double y) { return 5.0 * std::sin(x / 9 + y / 7); })));
  // A half ball, open below.
  Mesh dome =
      sheet(2.0, 40, [](double x, double y) { return std::sqrt(std::max(0.0, 1.0 - x * x - y * y)); });
  std::erase_if(dome.triangles, [&](const auto& t) { return dome.vertices_m[t[0]].z == 0.0; });
  EXPECT_FALSE(is_open_sheet(dome));
  // Two sheets back to back enclose what is between them.
  Mesh both = sheet(0.1, 2, [](double, double) { return 0.0; });
  for (auto t : sheet(0.1, 2, [](double, double) { return 0.0; }).triangles)
    both.triangles.push_back({t[0], t[2], t[1]});
  both = add({}, both, {});
  for (std::size_t i = 0; i < both.vertices_m.size(); ++i) both.vertices_m[i].z += i % 2 == 0 ? 0.01 : 0.0;
  EXPECT_FALSE(is_open_sheet(both));
  EXPECT_FALSE(is_open_sheet({}));
  // Sides of 53 degrees: a mean facing of 0.6.
  const Mesh valley = sheet(1.0, 20, [](double x, double) { return 4.0 / 3.0 * std::abs(x); });
  SheetOptions steep_too;
  steep_too.least_facing = 0.55;
  EXPECT_FALSE(is_open_sheet(valley));
  EXPECT_TRUE(is_open_sheet(valley, steep_too));
}

TEST(ReliefFromSheet, RaisesASheetOverItsBase) {
  const Mesh hill =
      sheet(0.06, 60, [](double x, double y) { return 0.004 * std::exp(-(x * x + y * y) / 2e-4); });
  Mesh mesh = hill;
  // An empty margin on all sides.
  for (const double x : {-0.05, 0.05})
    mesh = add(mesh, sheet(0.002, 1, [](double, double) { return 0.0; }), {x, x, 0});
  const auto relief = relief_from_sheet(mesh, {}, {});
  ASSERT_TRUE(relief);
  EXPECT_NEAR(relief->size_x_m(), 0.102, 1e-9);
  EXPECT_NEAR(relief->sample(0.0, 0.0).z_m, 0.005, 2e-5);
  EXPECT_NEAR(relief->sample(0.02, 0.02).z_m, 0.001 + 0.004 * std::exp(-4.0), 2e-5);
  EXPECT_NEAR(relief->sample(0.045, 0.0).z_m, 0.0, 1e-6);
}

TEST(ReliefFromSheet, RefusesMeshesWithoutAnExtentFromAboveAndOptionsOutOfRange) {
  Mesh wall;
  wall.vertices_m = {{0, 0, 0}, {0, 0, 1}, {0, 0, 2}};
  wall.triangles = {{0, 1, 2}};
  EXPECT_EQ(relief_from_sheet(wall, {}, {}).error().code, ErrorCode::invalid_input);
  EXPECT_EQ(relief_from_sheet({}, {}, {}).error().code, ErrorCode::invalid_input);
  SheetOptions options;
  options.thickness_m = 0.02;
  EXPECT_EQ(relief_from_sheet(sheet(0.1, 2, [](double, double) { return 0.0; }), options, {}).error().code,
            ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::sculpt
