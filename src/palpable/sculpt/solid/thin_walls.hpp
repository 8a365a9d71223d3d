// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <cstddef>
#include <memory>
#include <vector>

namespace palpable::sculpt {

/// How thin walls are treated. A field rounds walls thinner than two finest cells by up to a quarter of a
/// cell on each side, and loses those thinner than half of one.
struct WallOptions {
  /// Thinner walls are thickened to about this, in finest cells: with two, the field's rounding stays inside
  /// the wall. 0 … 8; 0 = walls do not change.
  double least_cells = 2.0;
};
std::vector<Parameter> parameters_of(WallOptions& options);

inline constexpr WallOptions kWallsAsTheyAre{0.0};

/// A solid whose thin walls were thickened on both sides.
struct ThickenedWalls {
  /// Null: no wall is too thin.
  std::unique_ptr<DistanceSource> distance;
  /// Triangles of walls too thin, and of sheets that enclose no solid.
  std::size_t thin = 0;
  std::size_t sheets = 0;
  /// Triangles of sheets that are the ground on which the solid stands, as the land of a city model: they
  /// face one direction, lie under all of the solid and reach beyond it. They are left out.
  std::size_t ground = 0;
  /// The most that was added to a side.
  double added_m = 0.0;
};

/// `solid` is bounded by the triangles of `surface`, and is taken only where something was thickened. The
/// first `sheet_candidates` triangles of `sheets_from` are sheets where they lie outside the solid.
/// `finest_m`: side of a field's finest cells. Options in their ranges. All threads.
ThickenedWalls thickened_walls(std::unique_ptr<DistanceSource>& solid, const Mesh& surface,
                               const Mesh& sheets_from, std::size_t sheet_candidates, double finest_m,
                               const WallOptions& options, const Work& work);

}  // namespace palpable::sculpt
