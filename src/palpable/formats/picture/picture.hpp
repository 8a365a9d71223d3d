// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>
#include <filesystem>

namespace palpable::formats {

/// Writes a PNG with exactly these values, atomically. Errors: failed (the system's reason; no pixels).
Result<void> write_png(const std::filesystem::path& path, const Raster<Rgb8>& picture);
Result<void> write_png(const std::filesystem::path& path, const Raster<std::uint8_t>& grey);
Result<void> write_png(const std::filesystem::path& path, const Raster<std::uint16_t>& grey);
Result<void> write_png(const std::filesystem::path& path, const Image& picture);

/// Writes a one-channel PFM without conversion, atomically.
Result<void> write_pfm(const std::filesystem::path& path, const Raster<float>& values);

/// Writes disparity in pixels (NaN or infinite = unknown) as PFM, where unknown is infinity.
Result<void> write_disparity_pfm(const std::filesystem::path& path, const Raster<float>& disparity_px);

/// Writes disparity in pixels as 16-bit PNG: disparity × 256, rounded; 0 = unknown, so a known disparity is
/// kept within 1/256 … 65535/256 px.
Result<void> write_disparity_png(const std::filesystem::path& path, const Raster<float>& disparity_px);

}  // namespace palpable::formats
