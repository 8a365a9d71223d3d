// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"

namespace palpable::recipes {

/// The distance of neighbouring coordinates at the corner of triangles that is farthest from the origin: in
/// single precision if all corners are numbers of single precision, else in double.
double coordinate_step(const Mesh& mesh);

/// Refuses a mesh without a surface to touch. Errors (invalid_input): all corners at one place; no triangle
/// with an area, because the corners of each are on one line, or because the mesh is so far from its origin
/// that its coordinates were rounded to a few places. Triangles with a
/// corner that is missing or not finite are left out.
Result<void> check_surface(const Mesh& mesh);

}  // namespace palpable::recipes
