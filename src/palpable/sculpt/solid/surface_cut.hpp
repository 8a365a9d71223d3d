// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstddef>
#include <cstdint>

namespace palpable::sculpt {

/// The surface of the solid that a mesh's triangles wind round at least once.
struct SolidSurface {
  /// Triangles facing outwards. Those that others cross are cut along the crossing lines, so corners may
  /// stand on other triangles' edges.
  Mesh mesh;
  /// Triangles of the mesh that have the solid on both of their sides, or on none.
  std::size_t inner = 0;
};

/// Whether a sample of the triangles, spread over all, has the solid behind and nothing before it: then the
/// mesh is its solid's surface already.
bool is_own_surface(const Mesh& mesh, const TriangleTree& tree, std::uint64_t seed);

/// Leaves out what lies inside the solid. `tree` holds the mesh. Pieces smaller than `finest_m` are not cut
/// further. Long work: all threads, polls cancel (then the surface is not whole).
SolidSurface surface_of(const Mesh& mesh, const TriangleTree& tree, double finest_m, const Work& work);

}  // namespace palpable::sculpt
