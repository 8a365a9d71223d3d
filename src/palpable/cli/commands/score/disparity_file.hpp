// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace palpable::cli {

/// Reads a disparity map in pixels, NaN = unknown. Stored values are disparity times `scale`; 0 means unknown
/// in integer pictures. If `scale` is not given: 1 for PFM and NumPy files, else 256, as `palpable depth`
/// writes PNG. Errors: invalid_input; also if no scale is given and 256 would make all disparities less than
/// a pixel, as with 8-bit pictures.
Result<Raster<float>> read_disparity(const std::filesystem::path& file, std::optional<double> scale);

/// Reads a mask: the picture's grey values, 8 bits.
Result<Raster<std::uint8_t>> read_mask(const std::filesystem::path& file);

}  // namespace palpable::cli
