// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>

namespace palpable::vision {

inline constexpr int kCensusHalfX = 4;  // the window is 9 x 7
inline constexpr int kCensusHalfY = 3;
inline constexpr int kCensusPixels = (2 * kCensusHalfX + 1) * (2 * kCensusHalfY + 1);

/// The census signature of each pixel: one bit for each pixel of its window that is darker than its centre
/// (Zabih & Woodfill 1994); the border's pixels are repeated. The Hamming distance of two says how unlike
/// they are, whatever the exposure.
Raster<std::uint64_t> census_9x7(const Raster<std::uint8_t>& grey, const Work& work);

/// Whether the pixel's census window has contrast enough to be found again; false near the border.
bool has_texture(const Raster<std::uint8_t>& grey, int x, int y);

/// The picture shrunk by a whole factor, each pixel the mean of factor x factor; a rest at the far borders is
/// left.
Raster<std::uint8_t> shrunk(const Raster<std::uint8_t>& grey, int factor);

}  // namespace palpable::vision
