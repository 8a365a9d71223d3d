// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// Where a triangle lies among the cells that a surface encloses.
enum class CellSide : std::uint8_t {
  /// The outside is on both of its sides, or the surface was not examined.
  open,
  /// The outside is on one of its sides.
  boundary,
  /// The outside is on neither of its sides.
  inner
};

/// The cells that surfaces enclose, whatever the orientation of their triangles. A surface consists of
/// triangles that are connected across edges. Around each edge, each triangle's side meets the facing side of
/// the next one (Attene, "As-exact-as-possible repair of unprintable STL files", 2018); sides that meet form
/// one shell. A shell with a volume, seen from within, is that of a cell; all others are of the outside, such
/// as both sides of walls without a floor and a ceiling under a closed roof. Where surfaces cross without
/// common edges, each has its own cells. `is_examined`: for each triangle, whether its surface is
/// examined, the same for all triangles of a surface. Triangles of boundaries are turned so that their front
/// is outside. Surfaces whose cells have hardly any volume stay as they are, open.
std::vector<CellSide> find_enclosed_cells(Mesh& mesh, std::span<const char> is_examined);

}  // namespace palpable::sculpt
