// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/solid/mesh_solid.hpp"
#include "palpable/sculpt/solid/test_solids.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sculpt {

// A scene of closed bodies and open sheets whose truth is known, and the error of a solid made from it. For
// tests.

inline constexpr double kCell_m = 0.0002;
/// No sheet is ground.
inline constexpr WallOptions kTwoCellWalls{.least_cells = 2.0, .ground_facing = 1.0};

/// Triangles over a grid of places; `place_m(u, v)` with u and v from 0 to 1.
template <class Place>
Mesh grid_sheet(std::uint32_t columns, std::uint32_t rows, const Place& place_m) {
  Mesh sheet;
  for (std::uint32_t j = 0; j <= rows; ++j)
    for (std::uint32_t i = 0; i <= columns; ++i)
      sheet.vertices_m.push_back(place_m(static_cast<double>(i) / columns, static_cast<double>(j) / rows));
  for (std::uint32_t j = 0; j < rows; ++j)
    for (std::uint32_t i = 0; i < columns; ++i) {
      const std::uint32_t a = j * (columns + 1) + i, b = a + 1, c = a + columns + 1, d = c + 1;
      sheet.triangles.push_back({a, b, d});
      sheet.triangles.push_back({a, d, c});
    }
  return sheet;
}

/// What the scenes consist of. Bodies know their distance; beside it the mesh may be wrong by `facets_m`.
struct SheetScene {
  Mesh mesh;
  Mesh sheets;
  std::vector<std::function<double(Vec3)>> bodies;
  double facets_m = 1e-6;
  std::string words;

  void add_sheet(const Mesh& sheet) {
    sheets = together(std::move(sheets), sheet);
    mesh = together(std::move(mesh), sheet);
  }
  double body_distance(Vec3 p) const {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& body : bodies) least = std::min(least, body(p));
    return least;
  }
  double sheet_distance(Vec3 p) const {
    double least2 = std::numeric_limits<double>::infinity();
    for (const auto& t : sheets.triangles)
      least2 = std::min(least2, nearest_on_triangle(p, sheets.vertices_m[t[0]], sheets.vertices_m[t[1]],
                                                    sheets.vertices_m[t[2]])
                                    .squared_distance_m2);
    return std::sqrt(least2);
  }
};

struct WorstPlace {
  double error_m = 0.0;
  Vec3 place_m;
  bool is_solid = false;
};

/// The greatest error of the solid at random places and beside its sheets.
inline WorstPlace worst_place(const SheetScene& scene, const MeshSolid& solid, std::mt19937_64& random) {
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Vec3> places;
  const Box box = bounds_of(scene.mesh);
  const Vec3 size = box.size_m() + Vec3{0.01, 0.01, 0.01}, low = box.least_m - Vec3{0.005, 0.005, 0.005};
  for (int k = 0; k < 4000; ++k)
    places.push_back(low +
                     Vec3{size.x * uniform(random), size.y * uniform(random), size.z * uniform(random)});
  for (const auto& t : scene.sheets.triangles) {
    const Vec3 a = scene.sheets.vertices_m[t[0]], b = scene.sheets.vertices_m[t[1]],
               c = scene.sheets.vertices_m[t[2]];
    const Vec3 normal = unit(cross(b - a, c - a)), middle = (a + b + c) / 3.0;
    for (const double by_m : {-0.003, -0.0006, 0.0, 0.0006, 0.003}) places.push_back(middle + by_m * normal);
  }
  WorstPlace worst;
  DistanceSource::Hint hint;
  for (const Vec3 p : places) {
    const double body_m = scene.body_distance(p), sheet_m = scene.sheet_distance(p) - kCell_m;
    const bool is_solid = solid.distance->at(p, hint).distance_m < 0.0;
    // Where a sheet leaves a body, its parts are found to within a cell.
    const double in_sheet_m = body_m > kCell_m ? -sheet_m - 0.1 * kCell_m : 0.0;
    const double error_m = is_solid ? std::min(body_m - scene.facets_m, sheet_m)
                                    : std::max(-body_m - scene.facets_m, in_sheet_m);
    if (error_m > worst.error_m) worst = {error_m, p, is_solid};
  }
  return worst;
}

}  // namespace palpable::sculpt
