// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/point_cloud.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

// PLY files (Turk 1994), ASCII and binary of either byte order, read by the header's own statements: every
// element in its order, every list, nothing missing and nothing left over. In the file's own coordinates.

/// No mesh with more is read.
inline constexpr std::size_t kMostTriangles = 20'000'000;

/// The faces of a PLY file as triangles; faces with fewer than three corners are left out, `tristrips` are
/// taken apart. Errors, invalid_input without a place: damage, less or more than the header states, an index
/// of no vertex, a coordinate that is not finite, over 20 million triangles. No triangle is no error.
Result<Mesh> decode_ply_mesh(std::span<const std::byte> file);

/// The vertices of a PLY file, with their normals (nx, ny, nz) where it has them. Errors as above; over 50
/// million points.
Result<PointCloud> decode_ply_points(std::span<const std::byte> file);

}  // namespace palpable::sources
