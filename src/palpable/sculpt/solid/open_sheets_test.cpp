// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Sheets without thickness near closed bodies: only the sheets and the bodies are solid.
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr double kFinestCell_m = 0.0002;
constexpr WallOptions kTwoCells{2.0};

/// A closed box and open sheets, before the rotation `turn` is applied.
struct BodyWithSheets {
  Vec3 low, high;
  Mesh sheets;

  double body_distance(Vec3 p) const { return box_distance(p, low, high); }
  double sheet_distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& t : sheets.triangles)
      least = std::min(least, std::sqrt(nearest_on_triangle(p, sheets.vertices_m[t[0]],
                                                            sheets.vertices_m[t[1]], sheets.vertices_m[t[2]])
                                            .squared_distance_m2));
    return least;
  }
};

/// A rotation about the axis (1, 2, 3).
Vec3 turned(Vec3 p, double angle) {
  const Vec3 axis = unit({1.0, 2.0, 3.0});
  return std::cos(angle) * p + std::sin(angle) * cross(axis, p) +
         ((1.0 - std::cos(angle)) * dot(axis, p)) * axis;
}

/// A convex polygon of one face as a fan; `p_m(u, v)` gives its plane, `reversed` the face.
template <class Place>
Mesh polygon_sheet(int corners, bool reversed, const Place& place_m) {
  Mesh sheet;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * (k + 0.5) / corners;
    sheet.vertices_m.push_back(place_m(std::cos(angle), std::sin(angle)));
  }
  for (std::uint32_t k = 1; k + 1 < static_cast<std::uint32_t>(corners); ++k)
    sheet.triangles.push_back(reversed ? std::array{0U, k + 1, k} : std::array{0U, k, k + 1});
  return sheet;
}

/// A box of whole millimetres and one to three sheets on, beside, in, through or near it, some of them in the
/// planes of its faces.
BodyWithSheets random_scene(std::mt19937_64& random) {
  const auto whole_mm = [&](int least, int most) {
    return 1e-3 * std::uniform_int_distribution<int>(least, most)(random);
  };
  BodyWithSheets scene;
  scene.low = {-whole_mm(5, 20), -whole_mm(5, 20), 0.0};
  scene.high = {whole_mm(5, 20), whole_mm(5, 20), whole_mm(4, 20)};
  const int count = std::uniform_int_distribution<int>(1, 3)(random);
  for (int k = 0; k < count; ++k) {
    const int across = std::uniform_int_distribution<int>(0, 2)(random),
              corners = std::uniform_int_distribution<int>(3, 7)(random);
    const bool reversed = random() % 2 == 0, upright = random() % 2 == 0;
    const double wide_m = whole_mm(4, 20), high_m = whole_mm(4, 20);
    const Vec3 at{whole_mm(-22, 22), whole_mm(-22, 22), upright ? scene.high.z + high_m : whole_mm(-4, 24)};
    scene.sheets =
        together(std::move(scene.sheets), polygon_sheet(corners, reversed, [&](double u, double v) -> Vec3 {
                   if (across == 0) return at + Vec3{0.0, wide_m * u, high_m * v};
                   if (across == 1) return at + Vec3{wide_m * u, 0.0, high_m * v};
                   return at + Vec3{wide_m * u, high_m * v, 0.0};
                 }));
  }
  return scene;
}

/// The greatest error of the solid, outwards into air and inwards into material, on a grid of whole and half
/// millimetres; metres.
double worst_wrong_side_m(const BodyWithSheets& scene, const MeshSolid& solid, double angle) {
  double worst_m = 0.0;
  DistanceSource::Hint hint;
  // Whole millimetres, exactly as in the sheets.
  const auto at_m = [](int half_mm) { return half_mm % 2 == 0 ? 1e-3 * (half_mm / 2) : 0.5e-3 * half_mm; };
  for (int k = -12; k <= 90; k += 3)
    for (int j = -84; j <= 84; j += 3)
      for (int i = -84; i <= 84; i += 3) {
        const Vec3 p{at_m(i), at_m(j), at_m(k)};
        const double body_m = scene.body_distance(p),
                     outside_m = std::min(body_m, scene.sheet_distance(p) - kFinestCell_m);
        const bool is_solid = solid.distance->at(turned(p, angle), hint).distance_m < 0.0;
        if (is_solid) worst_m = std::max(worst_m, outside_m);
        if (!is_solid) worst_m = std::max(worst_m, -body_m);
      }
  return worst_m;
}

TEST(OpenSheets, BesideOnAndThroughABodyTurnNoAirIntoSolid) {
  std::mt19937_64 random(20261122);
  for (int scene_number = 0; scene_number < 60; ++scene_number) {
    const BodyWithSheets scene = random_scene(random);
    const double angle = scene_number % 3 == 2 ? 0.7 : 0.0;
    Mesh mesh = together(box_mesh(scene.low, scene.high), scene.sheets);
    // Files store single precision, so the corners of a rotated sheet are not in one plane.
    for (Vec3& v : mesh.vertices_m) {
      v = turned(v, angle);
      if (angle != 0.0) v = {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    }
    const auto solid = solid_from_mesh(mesh, kFinestCell_m, {}, {}, kTwoCells);
    ASSERT_TRUE(solid) << scene_number;
    EXPECT_LT(worst_wrong_side_m(scene, *solid, angle), 2e-6) << "scene " << scene_number;
  }
}

TEST(OpenSheets, OfOneFaceOnAPlateAreWallsInTheField) {
  constexpr int kCells = 256;
  constexpr double kFinest = 0.0625 / kCells, kWall_m = -0.015625;
  for (const bool reversed : {false, true}) {
    // Powers of two, so that the wall lies exactly in a plane of the field's grid.
    BodyWithSheets scene{{-0.03125, -0.02, 0.0}, {0.03125, 0.02, 0.01}, {}};
    scene.sheets.vertices_m = {
        {kWall_m, -0.015, 0.01}, {kWall_m, 0.015, 0.01}, {kWall_m, 0.015, 0.03}, {kWall_m, -0.015, 0.03}};
    scene.sheets.triangles = {{0, 1, 2}, {0, 2, 3}};
    if (reversed)
      for (auto& t : scene.sheets.triangles) std::swap(t[1], t[2]);
    const auto solid =
        solid_from_mesh(together(box_mesh(scene.low, scene.high), scene.sheets), kFinest, {}, {}, kTwoCells);
    ASSERT_TRUE(solid);
    FieldOptions options;
    options.resolution = kCells;
    options.max_error_m = 20e-6;
    const auto field = field_from_source(*solid->distance, options, {});
    ASSERT_TRUE(field);
    double worst_m = 0.0;
    for (double z_m = 0.0; z_m < 0.031; z_m += 0.0007)
      for (double y_m = -0.02; y_m < 0.02; y_m += 0.0013)
        for (double x_m = -0.031; x_m < 0.031; x_m += 0.0007) {
          const Vec3 p{x_m, y_m, z_m};
          const double truth_m = std::min(scene.body_distance(p), scene.sheet_distance(p) - kFinest);
          if (field->sample({p}).distance_m < 0.0) worst_m = std::max(worst_m, truth_m);
        }
    // The field rounds edges within one finest cell.
    EXPECT_LT(worst_m, kFinest) << reversed;
  }
}

}  // namespace
}  // namespace palpable::sculpt
