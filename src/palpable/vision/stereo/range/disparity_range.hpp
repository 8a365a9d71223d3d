// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>

namespace palpable::vision {

/// Where a pair's disparities lie, in pixels, with a margin; and how well the two pictures agree.
struct DisparityRange {
  int min_px = 0;
  int max_px = 0;
  /// Of the pixels with texture, the fraction whose best match in the other picture points back: 0…1.
  /// Pictures of one scene give 0.3 and more, unrelated ones below 0.1.
  double agreement = 0.0;
  /// The fraction of pixels that have texture enough to be matched at all.
  double textured = 0.0;
};

/// The range of disparities from a small copy of the pair: each textured pixel's census signature is looked
/// for along the whole scanline, both ways; matches that are mutual and unique are counted in a histogram,
/// and the range is where the histogram stands out from the chance matches, which spread evenly. Works for
/// disparities from minus to plus three quarters of the width. Both pictures of the same size, not empty.
DisparityRange find_disparity_range(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                    const Work& work);

}  // namespace palpable::vision
