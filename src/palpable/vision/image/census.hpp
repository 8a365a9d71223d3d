// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <bit>
#include <cstdint>
#include <vector>

namespace palpable::vision {

inline constexpr int kCensusHalfX = 4;  // the window is 9 x 7
inline constexpr int kCensusHalfY = 3;
inline constexpr int kCensusPixels = (2 * kCensusHalfX + 1) * (2 * kCensusHalfY + 1);

/// The census signature of each pixel: one bit for each pixel of its window that is darker than its centre
/// (Zabih & Woodfill 1994); the border's pixels are repeated. The Hamming distance of two signatures measures
/// their dissimilarity, independent of the exposure.
Raster<std::uint64_t> census_9x7(const Raster<std::uint8_t>& grey, const Work& work);

/// Which pixels of a census window are compared (similar_pixels_9x7).
struct CensusOptions {
  /// Those that differ from the centre by less than this, in the channel that differs most; levels of 255, 1
  /// … 255.
  int similar_levels = 16;
  /// If fewer than this are similar, as in fine texture, all are compared; pixels, 1 … 63.
  int fewest_similar = 16;
};
std::vector<Parameter> parameters_of(CensusOptions& options);

/// For each pixel, a mask over its census signature: the bits of the pixels of similar colour, which mostly
/// belong to the same surface. With all bits compared, a strong edge beside a plain surface would give the
/// surface the edge's disparity within the window's reach (edge fattening).
Raster<std::uint64_t> similar_pixels_9x7(const ColourPlanes& picture, const CensusOptions& options,
                                         const Work& work);

/// A Hamming distance over the bits of `mask`, which has at least one, times census_scale(mask) /
/// kCensusScaleUnit, compares with one over all bits.
inline constexpr int kCensusScaleUnit = 64;
inline int census_scale(std::uint64_t mask) { return kCensusScaleUnit * kCensusPixels / std::popcount(mask); }

/// The contrast of a census window above the noise of an 8-bit picture: the mean difference from the centre,
/// in levels of 255.
inline constexpr int kTextureLevels = 4;

/// Whether the pixel's census window has more contrast than kTextureLevels; false near the border.
bool has_texture(const Raster<std::uint8_t>& grey, int x, int y);

/// The picture reduced by an integer factor, each pixel the mean of factor x factor; incomplete blocks at the
/// right and bottom are dropped.
Raster<std::uint8_t> shrunk(const Raster<std::uint8_t>& grey, int factor);

}  // namespace palpable::vision
