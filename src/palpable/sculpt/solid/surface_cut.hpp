// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstddef>

namespace palpable::sculpt {

/// The surface of the solid in which a mesh's winding number is at least one.
struct SolidSurface {
  /// Triangles facing outwards. Those that others cross are cut along the crossing lines, so corners may
  /// lie on other triangles' edges.
  Mesh mesh;
  /// Triangles of the mesh that have the solid on both of their sides, or on none.
  std::size_t inner = 0;
};

/// Thinner parts of a mesh are no solid, as a share of the diagonal of its box: 0.4 um in 200 mm. Both sides
/// of a triangle are tested at half of this distance from it; files in single precision are exact to a
/// thirtieth.
inline constexpr double kThinnestSolid = 4e-6;

/// Whether the solid lies behind every triangle and nothing before it, by the winding number: then the mesh
/// is its solid's surface already. Tested at the centre of each triangle; for those from `first_added` on,
/// and for all that are near them, at six more places. `tree` holds the mesh. All threads; polls cancel.
bool is_own_surface(const Mesh& mesh, const TriangleTree& tree, std::size_t first_added, const Work& work);

/// Leaves out what lies inside the solid. `tree` holds the mesh. Pieces smaller than `finest_m` are not cut
/// further. Long work: all threads, polls cancel (then the surface is not whole).
SolidSurface surface_of(const Mesh& mesh, const TriangleTree& tree, double finest_m, const Work& work);

}  // namespace palpable::sculpt
