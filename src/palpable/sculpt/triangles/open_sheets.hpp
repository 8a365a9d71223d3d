// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/sculpt/triangles/hole_closing.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// How open sheets (a floor with a wall, a curved screen, a tent) are distinguished from bodies with holes.
/// The lid of a body's hole is small against its surface, or flat. The rim of a sheet is its outline, so it
/// reaches through the sheet's whole height.
struct OpenSheetOptions {
  /// Greatest area of a body's lids as a share of its surface, each lid multiplied by the height of its rim
  /// over that of the body; heights are along the lid's mean normal. 0 ... 10.
  double most_tall_lids = 0.15;
  /// Greatest area of lids as a share of the surface if these meet it at sharp angles, as a dish's do,
  /// 0 ... 10.
  double most_sharp_lids = 0.8;
  /// Mean angle between a lid and the surface at its rim, below which it is sharp, degrees, 0 ... 180.
  double sharp_angle_deg = 60.0;
  /// Greatest area of lids as a share of the surface in any case, 0 ... 10: a hoop has more.
  double most_lids = 0.99;
  /// Greatest area of the lids of a two-sided surface as a share of its area if it is a body, 0 ... 10: such
  /// a surface is visible from both sides, so that only small holes, as those of a scan, are closed.
  double most_two_sided_lids = 0.02;
  /// Smaller lids, as a share of the surface's area, are never outlines, 0 ... 1.
  double least_lid = 0.01;
  /// Of several tall lids those are outlines whose rims reach through at least this share of the surface's
  /// height, 0 ... 1.
  double least_outline_height = 0.25;
  /// Greatest share of a rim that is neither on nor in bodies if the surface is no sheet, 0 ... 1.
  double most_free_rim = 0.02;
};
std::vector<Parameter> parameters_of(OpenSheetOptions& options);

/// Which triangles of a mesh belong to open sheets.
struct OpenSheets {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  /// For each triangle the number of its sheet, or kNone. Empty if there is no sheet.
  std::vector<std::uint32_t> of_triangle;
  std::size_t count = 0;
};

/// Finds the open sheets. `holes` are those of the mesh (holes_of()), whose neighbouring triangles face the
/// same way. Where sheets and bodies share edges, the parts with a sheet's rim are removed first, and what
/// remains is judged again. A surface whose rim lies wholly on or in bodies, within `touching_m`, is no
/// sheet: nobody can reach behind it, as behind a moulding on a wall. The options must be in range.
OpenSheets open_sheets_of(const Mesh& mesh, std::span<const Hole> holes, double touching_m,
                          const OpenSheetOptions& options);

}  // namespace palpable::sculpt
