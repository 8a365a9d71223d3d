// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

#include <cstddef>
#include <vector>

namespace palpable::sculpt {

/// What merge_coincident() found.
struct CoincidentTriangles {
  /// Triangles that were removed since another one has the same vertices and orientation.
  std::size_t repeated = 0;
  /// For each remaining triangle, whether another one with the opposite orientation was removed. Empty if
  /// there is none.
  std::vector<char> is_two_sided;
};

/// Keeps one of the triangles with the same three vertices; the first one. Two triangles that form a flat
/// quadrilateral with one diagonal coincide with two of the opposite orientation that form it with the other
/// diagonal. The mesh must be welded.
CoincidentTriangles merge_coincident(Mesh& mesh);

}  // namespace palpable::sculpt
