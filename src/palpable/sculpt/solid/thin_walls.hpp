// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace palpable::sculpt {

/// How thin walls are treated. A field rounds walls thinner than two finest cells by up to a quarter of a
/// cell on each side, and loses those thinner than half of one.
struct WallOptions {
  /// Thinner walls are thickened to about this, in finest cells: with two, the field's rounding stays inside
  /// the wall. 0 … 8; 0 = walls do not change.
  double least_cells = 2.0;
  /// A sheet is the ground around the solid if its middle is in this lowest share of the solid's height or
  /// lower, 0 … 1,
  double ground_height = 0.25;
  /// at least this share of its area faces up or down, 0.5 … 1,
  double ground_facing = 0.75;
  /// and it extends beyond the solid by at least this share of the solid's longest side, 0 … 1.
  double ground_beyond = 0.05;
  /// The other face of a thin wall is at most this far from parallel, as a cosine, 0 … 1.
  double opposite_cosine = 0.9;
  /// A wall that lacks less than this share of the least thickness is thick enough, 0 … 1.
  double least_lack = 0.02;
  /// Of four points of a triangle, at least this many must lie on a thin wall, or outside the solid if it is
  /// a sheet, 1 … 4.
  int least_points = 3;
  /// Number of different thicknesses that are added, so that each wall gets about what it lacks, 1 … 16.
  int thickness_steps = 4;
  /// Sheets are divided where they leave the solid, down to pieces of this size; larger pieces than the
  /// second are always divided. Finest cells, 0.1 … 1000.
  double least_piece_cells = 1.0;
  double most_piece_cells = 32.0;
  /// The axis of the mesh that points up; of length 1. Follows from how the solid is placed.
  Vec3 up{0.0, 0.0, 1.0};
};
std::vector<Parameter> parameters_of(WallOptions& options);

inline constexpr WallOptions kWallsAsTheyAre{0.0};

/// A solid whose thin walls were thickened on both sides.
struct ThickenedWalls {
  /// Null: no wall is too thin.
  std::unique_ptr<DistanceSource> distance;
  /// Number of open sheets, of which a part is outside the solid and not ground, and of their triangles.
  std::size_t open_sheets = 0;
  std::size_t open_sheet_triangles = 0;
  /// Number of triangles of walls that are too thin, and of all sheets that enclose no solid.
  std::size_t thin = 0;
  std::size_t sheets = 0;
  /// Number of triangles of sheets that are the ground on which the solid stands, such as the land of a city
  /// model (WallOptions::ground_facing). They are omitted.
  std::size_t ground = 0;
  /// Greatest thickness added to a side.
  double added_m = 0.0;
};

/// Triangles that are sheets where they are outside the solid.
struct SheetCandidates {
  const Mesh& mesh;
  /// For each triangle the number of its open sheet, or OpenSheets::kNone.
  std::vector<std::uint32_t> open_sheet;
};

/// Thickens the thin walls of `solid`, whose surface is `surface`; `solid` is moved from only if something
/// was thickened. Null and an empty surface: there are only sheets. `finest_m`: side of a field's finest
/// cells. The options must be in range. All threads.
ThickenedWalls thickened_walls(std::unique_ptr<DistanceSource>& solid, const Mesh& surface,
                               const SheetCandidates& sheets, double finest_m, const WallOptions& options,
                               const Work& work);

}  // namespace palpable::sculpt
