// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <span>

namespace palpable::sources {

// PLY files (Turk 1994), ASCII and binary in either byte order, read strictly by their header: every element
// in its order, every list, nothing missing and nothing left. In the file's own coordinates.

/// Greatest number of triangles of a mesh.
inline constexpr std::size_t kMostTriangles = 20'000'000;

/// The faces of a PLY file as triangles. Faces with fewer than three corners are omitted; `tristrips` are
/// split. Errors, invalid_input without a place: damage, less or more data than the header states, an invalid
/// vertex index, a coordinate that is not finite, more than 20 million triangles. A file without triangles is
/// valid.
Result<Mesh> decode_ply_mesh(std::span<const std::byte> file);

/// The vertices of a PLY file, with their normals (nx, ny, nz) if present. Errors as above; more than 50
/// million points.
Result<PointCloud> decode_ply_points(std::span<const std::byte> file);

}  // namespace palpable::sources
