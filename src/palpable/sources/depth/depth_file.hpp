// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/files/file_bytes.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

namespace palpable::sources {

/// Reads the numbers of a one-channel file without conversion: 8 and 16-bit integers (PNG, TIFF, PGM …),
/// floats (PFM, TIFF, OpenEXR's Z), NumPy arrays (NPY, or NPZ that contains one two-dimensional array or one
/// named `depth`, `depth_m`, `disparity` or `arr_0`). An EXIF orientation is applied. A colour picture is
/// accepted if its channels are equal. Errors: invalid_input, with the file's name, as read_picture(); a
/// picture with colours.
Result<Raster<float>> read_raster(const std::filesystem::path& path);
/// The same from memory; errors without a place.
Result<Raster<float>> decode_raster(FileView file);

struct DepthFile {
  DepthMap depth;
  /// Number of pixels without depth: zero, negative, infinite or not a number.
  std::size_t unknown = 0;
};

/// Reads depth in metres: value × metres_per_unit; values that are not positive and finite are unknown. Such
/// a file does not state the camera. Errors: as read_raster(); usage if metres_per_unit is not positive and
/// finite; invalid_input if no pixel has a depth.
Result<DepthFile> read_depth(const std::filesystem::path& path, double metres_per_unit);

struct DisparityFile {
  DisparityMap disparity;
  /// Number of pixels without disparity.
  std::size_t unknown = 0;
};

/// Values of a disparity file that mean "unknown", in addition to those that are not finite or negative.
enum class UnknownDisparity { not_finite, zero_too };

/// Reads disparity in pixels: value × px_per_unit (1/256 for the PNG that this program writes, 1/4 for
/// Middlebury's cones). Integer files mark unknown pixels by zero: use zero_too. Errors: as read_depth().
Result<DisparityFile> read_disparity(const std::filesystem::path& path, double px_per_unit,
                                     UnknownDisparity unknown);

/// The same for values in memory.
DepthFile depth_from_values(const Raster<float>& values, double metres_per_unit);

}  // namespace palpable::sources
