// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstddef>
#include <cstdint>

namespace palpable::sculpt {

/// The mesh with vertices at the same place made one, without triangles that have no area, or that name a
/// vertex that is not finite or not there. `removed` counts them.
Mesh welded(const Mesh& mesh, std::size_t& removed);

/// Makes neighbouring triangles agree about their outer side, then turns each connected part outwards where
/// most rays from its front meet an odd number of triangles (Takayama et al. 2014). Parts that meet in edges
/// of more than two triangles are then turned so that as little as possible of these edges is left open: of
/// walls that two bodies share, rays cannot decide. Returns how many parts were turned.
std::size_t orient_outwards(Mesh& mesh, std::uint64_t seed);

/// Of a mesh whose holes are closed: turns the connected parts in front of which the winding number is
/// mostly negative. `tree` holds the mesh as it was. Returns how many.
std::size_t turn_inside_out_parts(Mesh& mesh, const TriangleTree& tree);

}  // namespace palpable::sculpt
