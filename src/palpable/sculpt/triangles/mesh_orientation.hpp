// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstddef>
#include <cstdint>

namespace palpable::sculpt {

/// Merges vertices at the same position and removes triangles that have no area or refer to a vertex that is
/// missing or not finite. `removed` counts them.
Mesh welded(const Mesh& mesh, std::size_t& removed);

/// Orients neighbouring triangles consistently, then turns connected parts outwards. A part that encloses a
/// volume is turned if the volume is negative, unless it is the wall of a cavity; the others, if most rays
/// from their front side cross an odd number of triangles (Takayama et al. 2014). Rays cannot decide about
/// walls that two bodies share. So parts that meet in edges of more than two triangles are then oriented such
/// that the open length of these edges is least. The first `oriented` triangles face outwards already and
/// stay as they are; no edge connects them with the others. Returns the number of turned parts.
std::size_t orient_outwards(Mesh& mesh, std::uint64_t seed, std::size_t oriented = 0);

/// For a mesh whose holes are closed: turns the connected parts in front of which the winding number is
/// mostly negative. `tree` contains the mesh before the change. Returns their number.
std::size_t turn_inside_out_parts(Mesh& mesh, const TriangleTree& tree);

}  // namespace palpable::sculpt
