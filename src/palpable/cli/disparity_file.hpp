// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>

namespace palpable::cli {

/// A disparity map in pixels, NaN = unknown, whose stored values are disparity times `scale`. In pictures of
/// integers 0 is unknown. Not given: 1 for PFM and NumPy files, else 256, as `palpable depth` writes PNG.
/// Errors: invalid_input, also where a scale is not given and 256 would leave all below a pixel, as with
/// 8-bit pictures.
Result<Raster<float>> read_disparity(const std::filesystem::path& file, std::optional<double> scale);

/// A mask: the picture's grey values, 8 bit.
Result<Raster<std::uint8_t>> read_mask(const std::filesystem::path& file);

}  // namespace palpable::cli
