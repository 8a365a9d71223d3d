// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>

namespace palpable::sources {

/// The numbers in a one-channel file, exactly as they stand there: 8 and 16-bit integers (PNG, TIFF, PGM …),
/// floats (PFM, TIFF, OpenEXR's Z), NumPy arrays (NPY, or NPZ that holds one two-dimensional array or one
/// named `depth`, `depth_m`, `disparity` or `arr_0`). An orientation that a camera noted is applied. A colour
/// picture is taken where its channels are equal. Errors: invalid_input, with the file's name, as
/// read_picture() gives them; a coloured picture.
Result<Raster<float>> read_raster(const std::filesystem::path& path);
/// The same from memory; errors without a place.
Result<Raster<float>> decode_raster(std::span<const std::byte> file);

struct DepthFile {
  DepthMap depth;
  /// Pixels of the file that carry no depth: zero, negative, infinite or not a number.
  std::size_t unknown = 0;
};

/// Depth in metres: value × metres_per_unit; what is not positive and finite is unknown. The camera is not
/// stated by such a file. Errors: as read_raster(); usage where metres_per_unit is not positive and finite;
/// invalid_input where no pixel has a depth.
Result<DepthFile> read_depth(const std::filesystem::path& path, double metres_per_unit);

struct DisparityFile {
  DisparityMap disparity;
  /// Pixels of the file that carry no disparity.
  std::size_t unknown = 0;
};

/// Values of a disparity file that mean "unknown", besides those that are not finite or negative.
enum class UnknownDisparity { not_finite, zero_too };

/// Disparity in pixels: value × px_per_unit (1/256 for our own PNG, 1/4 for Middlebury's cones). Integer
/// files mark unknown pixels by zero: say so with zero_too. Errors: as read_depth().
Result<DisparityFile> read_disparity(const std::filesystem::path& path, double px_per_unit,
                                     UnknownDisparity unknown);

/// The same on values at hand; for rasters that came from elsewhere.
DepthFile depth_from_values(const Raster<float>& values, double metres_per_unit);

}  // namespace palpable::sources
