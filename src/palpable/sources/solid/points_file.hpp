// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/point_cloud.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <span>

namespace palpable::sources {

/// Reads the points of a PLY file, with their normals (nx, ny, nz) if present, in the file's own coordinates.
/// Errors: invalid_input, naming the file, for an unreadable file, or more than 50 million points.
Result<PointCloud> read_points(const std::filesystem::path& path);

/// The same in memory. Errors without a place.
Result<PointCloud> decode_points(std::span<const std::byte> file);

}  // namespace palpable::sources
