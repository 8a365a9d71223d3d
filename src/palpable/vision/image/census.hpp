// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

namespace palpable::vision {

inline constexpr int kCensusHalfX = 4;  // the window is 9 x 7
inline constexpr int kCensusHalfY = 3;
inline constexpr int kCensusPixels = (2 * kCensusHalfX + 1) * (2 * kCensusHalfY + 1);

/// The census signature of each pixel: one bit for each pixel of its window that is darker than its centre
/// (Zabih & Woodfill 1994); the border's pixels are repeated. The Hamming distance of two says how unlike
/// they are, whatever the exposure.
Raster<std::uint64_t> census_9x7(const Raster<std::uint8_t>& grey, const Work& work);

/// For each pixel, the bits of its census signature that stand for pixels of like colour, of its own surface
/// mostly. Only they should count: else a strong edge beside a plain surface gives that surface the edge's
/// disparity as far as the window reaches. Where hardly anything is alike, as in fine texture, all bits
/// count.
Raster<std::uint64_t> alike_9x7(const ColourPlanes& picture, const Work& work);

/// A Hamming distance over the bits of `alike`, times census_scale(alike) / kCensusScaleUnit, compares with
/// one over all bits. Few bits say little and are scaled less.
inline constexpr int kCensusScaleUnit = 64;
inline int census_scale(std::uint64_t alike) {
  constexpr int kFewest = 16;
  return kCensusScaleUnit * kCensusPixels / std::max(kFewest, std::popcount(alike));
}

/// Whether the pixel's census window has contrast enough to be found again; false near the border.
bool has_texture(const Raster<std::uint8_t>& grey, int x, int y);

/// The picture shrunk by a whole factor, each pixel the mean of factor x factor; a rest at the far borders is
/// left.
Raster<std::uint8_t> shrunk(const Raster<std::uint8_t>& grey, int factor);

}  // namespace palpable::vision
