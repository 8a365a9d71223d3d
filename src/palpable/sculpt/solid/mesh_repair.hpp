// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/hole_closing.hpp"
#include "palpable/sculpt/triangles/open_sheets.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace palpable::sculpt {

/// A hole that was closed.
struct ClosedHole {
  /// The bounding box of its rim.
  Box rim;
  /// The area of the triangles that close it, and the direction in which they face, of length 1; zero for a
  /// lid that faces everywhere.
  double area_m2 = 0.0;
  Vec3 facing;
};

/// Defects of a mesh that were found and repaired.
struct MeshRepair {
  std::size_t triangles = 0;
  /// Triangles with a vertex that is missing or not finite, and triangles without an area; both are omitted.
  std::size_t not_finite = 0;
  std::size_t degenerate = 0;
  /// Triangles that occur more than once with the same orientation; the others of each are omitted.
  std::size_t repeated = 0;
  /// Triangles that occur with both orientations and were used once; closed surfaces that contain some, which
  /// bound solid; those of them that lie in another body; and open surfaces of them, which are sheets.
  std::size_t two_sided = 0;
  std::size_t two_sided_bodies = 0;
  std::size_t two_sided_inner_shells = 0;
  std::size_t two_sided_sheets = 0;
  /// Parts that were turned to face outwards.
  std::size_t turned_parts = 0;
  /// Holes that were closed by triangles between the vertices of their rims.
  std::size_t closed_holes = 0;
  /// The largest of them by area, at most kListedHoles, the largest first.
  std::vector<ClosedHole> largest_holes;
  static constexpr std::size_t kListedHoles = 3;
  /// Triangles with the solid on both sides or on none: not part of its surface.
  std::size_t inner = 0;
  /// Number of facets that were smoothed, and the greatest distance of the smooth surface from them.
  std::size_t rounded = 0;
  double rounded_m = 0.0;
  /// Open sheets without thickness, which have air on both sides (open_sheets.hpp), and their triangles.
  std::size_t open_sheets = 0;
  std::size_t open_sheet_triangles = 0;
  /// Number of triangles of walls that were too thin for the field, and of all sheets without thickness,
  /// which include the open ones; the least thickness of these walls now; and the greatest thickness added
  /// to a side.
  std::size_t thin = 0;
  std::size_t sheets = 0;
  /// Number of triangles of sheets that are the ground around the solid; omitted.
  std::size_t ground = 0;
  double wall_m = 0.0;
  double thickened_m = 0.0;
  /// Counts holes that are closed by their lids.
  void add_closed(std::span<const Vec3> vertices_m, std::span<const Hole> holes);
  /// One sentence each, for the user. Places are in mm in the mesh's frame; directions are named as in a
  /// scene (x right, y up, z towards the user).
  std::vector<std::string> notes() const;
};

/// A welded mesh whose parts face outwards, separated into bodies and open sheets.
struct RepairedMesh {
  /// The bodies, and their holes, which are still open.
  Mesh whole;
  std::vector<Hole> holes;
  /// The open sheets, with the same vertices; for each of their triangles the number of its sheet.
  Mesh sheets;
  std::vector<std::uint32_t> sheet_of;
  std::size_t sheet_count = 0;
};

/// Welds a mesh, orients its parts and removes its open sheets, and counts in `repair` what it did.
///
/// A triangle that occurs twice with opposite orientations is one two-sided surface
/// (coincident_triangles.hpp). Where two-sided triangles, with the others, enclose cells
/// (enclosed_cells.hpp), they bound solid, since nothing says whether a shell inside another one is a cavity.
/// Open surfaces of them are sheets, unless their holes are small (OpenSheetOptions::most_two_sided_lids).
/// Surfaces that are not consistently oriented and have edges of more than two triangles are examined for
/// cells too. The rest is oriented as in mesh_orientation.hpp and judged as in open_sheets.hpp, with
/// `touching_m`. Bodies that are left with holes may be joined (joined_bodies.hpp).
RepairedMesh repaired(const Mesh& mesh, double touching_m, const OpenSheetOptions& options,
                      std::uint64_t seed, MeshRepair& repair);

}  // namespace palpable::sculpt
