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

/// How walls thinner than a field can represent are treated: it rounds what is thinner than two finest cells
/// by up to a quarter of a cell a side, and loses what is thinner than half of one.
struct WallOptions {
  /// Thinner walls become about this thick, in finest cells: two of them keep the field's rounding inside the
  /// wall. 0 … 8; 0 = every wall as it is.
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
