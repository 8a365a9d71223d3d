// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/solid/mesh_repair.hpp"
#include "palpable/sculpt/solid/thin_walls.hpp"
#include "palpable/sculpt/triangles/open_sheets.hpp"

#include <cstddef>
#include <memory>
#include <optional>

namespace palpable::sculpt {

/// How the facets of a valid mesh are replaced by the smooth surface that they approximate (SmoothSurface).
/// The noise of a scan that a field may omit was chosen on the generated meshes of bench/scanned_meshes.hpp:
/// 5 to 6 um rms from their facets at 100 mm and 512 cells.
struct FacetOptions {
  /// Greatest distance of the smooth surface from the facets, metres, >= 0; 0 = the facets themselves.
  double rounding_m = 0.0;
  /// Only facets are smoothed whose points are all within this distance of an edge, in finest cells, >= 0.
  double most_cells_to_edge = 2.0;
  /// If the share of such facets is smaller, none is smoothed, 0 ... 1.
  double least_share = 0.1;
  /// Accuracy of a field relative to the smooth surface: see SmoothSurface::Rounding, each 0 ... 10.
  double coarse_share = 0.1;
  double noise_turn_share = 5.0;
  double noise_rise_share = 0.3;
  /// The share of a facet's rise and turn that a field may omit where bodies overlap: their surface is cut
  /// along itself and not smoothed. 0 ... 10.
  double cut_rise_share = 0.5, cut_turn_share = 1.0;
};

struct MeshSolid {
  std::unique_ptr<DistanceSource> distance;
  MeshRepair repair;
};

/// The solid that a mesh encloses, with its exact distance. A closed mesh that faces outwards is used
/// unchanged. In other meshes, parts are oriented outwards (by ray parity, Takayama et al. 2014), open sheets
/// are set apart (open_sheets.hpp), and the holes of the rest are closed. The solid is where the winding
/// number is at least one (generalised winding number, Jacobson et al. 2013). Triangles inside the solid,
/// where bodies overlap, are omitted. Triangles that are partly inside are cut along the lines where others
/// cross them, into pieces no smaller than `finest_m`, the side of the field's finest cells. The facets of an
/// unchanged mesh are smoothed as in `facets`. Walls that are too thin for `walls`, and sheets outside the
/// solid, are thickened on both sides (thin_walls.hpp); where walls stay as they are, sheets are not solid.
/// Errors: invalid_input for a mesh without triangles or without a volume, interrupted.
Result<MeshSolid> solid_from_mesh(const Mesh& mesh, double finest_m, const Work& work,
                                  const FacetOptions& facets = {}, const WallOptions& walls = kWallsAsTheyAre,
                                  const OpenSheetOptions& sheets = {});

/// An error if making the solid of a mesh with this many triangles would need more than `free_bytes`; it
/// states the need, and how many triangles fit.
std::optional<Error> mesh_too_large(std::size_t triangles, std::size_t free_bytes);

/// The solid inside a contoured surface (dual_contour.hpp). Its triangles face outwards and are closed,
/// though its sheets may touch, so nothing is repaired. Errors: invalid_input for a mesh without triangles.
Result<std::unique_ptr<DistanceSource>> solid_from_contour(const Mesh& mesh);

}  // namespace palpable::sculpt
