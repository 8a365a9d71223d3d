// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

#include <cstddef>

namespace palpable::sculpt {

/// Joins vertices of rims that are at most `near_m` apart, which must be positive, and removes the triangles
/// that then have two equal corners; returns their number. A rim is an edge of an odd number of triangles. In
/// files whose faces were computed one by one, corners that are the same differ in their last digits.
/// Vertices inside surfaces stay as they are, and so does a mesh without rims. The mesh must be welded.
std::size_t join_near_rims(Mesh& mesh, double near_m);

}  // namespace palpable::sculpt
