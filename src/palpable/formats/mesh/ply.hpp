// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <vector>

namespace palpable::formats {

/// Binary little-endian PLY in metres: float x, y, z, and triangles. Errors: failed for a mesh without
/// triangles.
Result<std::vector<std::byte>> encode_ply(const Mesh& mesh);

/// The same of points, without triangles, normals and unit. Errors: failed for a cloud without points.
Result<std::vector<std::byte>> encode_ply(const PointCloud& cloud);

}  // namespace palpable::formats
