// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// Closes each hole by triangles between the vertices of its rim (triangulated_hole()). A rim is a loop of
/// edges with more triangles in one direction than in the other; where bodies share walls, their common rim
/// is closed. The new triangles are appended. Returns the number of holes.
std::size_t close_holes(Mesh& mesh);

/// Triangles that close a hole without new vertices, as indices into its rim: of all triangulations without a
/// fold (neighbours that turn by more than 120 degrees; where each has one, those with the least) that of
/// least area (Barequet & Sharir 1995; folds as in Liepa 2003). A flat rim gets a flat lid, whatever its
/// outline. `rim`: at least three places in the order of the surface's own edges; `normals`: of the surface's
/// triangle at the edge from place i to the next one, or zero where it does not matter. A rim of more than
/// 256 places is divided by its shortest chord first. Triangles without an area are left out.
std::vector<std::array<std::uint32_t, 3>> triangulated_hole(std::span<const Vec3> rim,
                                                            std::span<const Vec3> normals);

}  // namespace palpable::sculpt
