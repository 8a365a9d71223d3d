// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/solid/thin_walls.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::sculpt {

/// What was found and repaired in a mesh on its way to a solid.
struct MeshRepair {
  std::size_t triangles = 0;
  /// Triangles with a vertex that is not finite or not there, and triangles without an area: left out.
  std::size_t not_finite = 0;
  std::size_t degenerate = 0;
  /// Parts that were turned to face outwards.
  std::size_t turned_parts = 0;
  /// Holes that were closed by triangles between the vertices of their rims.
  std::size_t closed_holes = 0;
  /// Triangles that have the solid on both of their sides, or on none: not part of its surface.
  std::size_t inner = 0;
  /// Facets that were smoothed, and how far at most the smooth surface lies beside them.
  std::size_t rounded = 0;
  double rounded_m = 0.0;
  /// Triangles of walls that were too thin for the field, those of sheets without thickness among them, the
  /// thickness that these walls have now, at least, and the most that was added to a side.
  std::size_t thin = 0;
  std::size_t sheets = 0;
  /// Of sheets that are the ground around the solid: left out.
  std::size_t ground = 0;
  double wall_m = 0.0;
  double thickened_m = 0.0;
  /// One sentence each, for the person.
  std::vector<std::string> notes() const;
};

/// How the facets of a mesh that is taken as it is become the smooth surface that they approximate
/// (SmoothSurface). What a field may leave out of a scan's noise was chosen on the generated meshes of
/// bench/scanned_meshes.hpp: 5 to 6 um rms beside their facets at 100 mm and 512 cells.
struct FacetOptions {
  /// The smooth surface lies no farther beside the facets; 0 = the facets themselves. Metres, >= 0.
  double rounding_m = 0.0;
  /// Facets are smoothed if none of their places is farther than this from an edge, in finest cells, >= 0.
  double most_cells_to_edge = 2.0;
  /// A mesh with a smaller share of such facets keeps all of them, 0 ... 1.
  double least_share = 0.1;
  /// How closely a field follows the smooth surface: see SmoothSurface::Rounding, each 0 ... 10.
  double coarse_share = 0.1;
  double noise_turn_share = 5.0;
  double noise_rise_share = 0.3;
};

struct MeshSolid {
  std::unique_ptr<DistanceSource> distance;
  MeshRepair repair;
};

/// The solid that a mesh bounds, with its exact distance. A closed, outward mesh is taken as it is. Of
/// others: parts are turned to face outwards (by the parity of rays, as Takayama et al. 2014), holes closed,
/// and the solid is where the winding number is at least one (generalised winding number, Jacobson et al.
/// 2013); triangles inside the solid, where bodies overlap, are left out, and those that are partly inside
/// cut along the lines where others cross them, into pieces no smaller than `finest_m`, the
/// side of the field's finest cells. The facets of a mesh that is taken as it is are smoothed as `facets`
/// says. Walls thinner than `walls` says, and sheets outside the solid, are thickened on both sides
/// (thin_walls.hpp). Errors: invalid_input for a mesh without triangles or without a volume, interrupted.
Result<MeshSolid> solid_from_mesh(const Mesh& mesh, double finest_m, const Work& work,
                                  const FacetOptions& facets = {},
                                  const WallOptions& walls = kWallsAsTheyAre);

/// An error if the solid of a mesh of so many triangles would need more than `free_bytes` while it is made:
/// it states what it would need, and how many triangles fit.
std::optional<Error> mesh_too_large(std::size_t triangles, std::size_t free_bytes);

/// The solid inside a surface that was contoured (dual_contour.hpp): its triangles face outwards and close,
/// though its sheets may touch, so nothing is repaired. Errors: invalid_input for a mesh without triangles.
Result<std::unique_ptr<DistanceSource>> solid_from_contour(const Mesh& mesh);

}  // namespace palpable::sculpt
