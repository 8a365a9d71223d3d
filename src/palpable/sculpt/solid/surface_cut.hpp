// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstddef>

namespace palpable::sculpt {

/// The surface of the solid in which a mesh's winding number is at least one.
struct SolidSurface {
  /// Triangles facing outwards. Triangles that cross others are cut along the crossing lines, so corners may
  /// be on edges of other triangles.
  Mesh mesh;
  /// Number of triangles of the mesh with the solid on both sides or on none.
  std::size_t inner = 0;
};

/// Parts of a mesh that are thinner than this share of the diagonal of its box are not solid: 0.4 um in 200
/// mm. Both sides of a triangle are tested at half of this distance from it; the rounding of single-precision
/// files is a thirtieth of it.
inline constexpr double kThinnestSolid = 4e-6;

/// Whether the solid is behind every triangle and not in front of it, by the winding number: then the mesh
/// already is the solid's surface. Tested at the centre of each triangle; for those from `first_added` on,
/// and for all near them, at six more points. `tree` contains the mesh. All threads; polls cancel.
bool is_own_surface(const Mesh& mesh, const TriangleTree& tree, std::size_t first_added, const Work& work);

/// Removes the triangles inside the solid. `tree` contains the mesh. Pieces smaller than `finest_m` are not
/// cut further. Long work: all threads, polls cancel (then the surface is incomplete).
SolidSurface surface_of(const Mesh& mesh, const TriangleTree& tree, double finest_m, const Work& work);

}  // namespace palpable::sculpt
