// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <vector>

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

/// How the range of disparities is found.
struct RangeOptions {
  /// The pair is reduced by a whole factor to about this width; px, 32 … 2048.
  int coarse_width_px = 224;
  /// Rows of it that are matched; 8 … 2048.
  int rows = 64;
  /// The next best match elsewhere must differ by so many census bits more; 0 … 63.
  int unique_bits = 3;
  /// Matches within two columns and a row that agree within a pixel, itself included; 1 … 15.
  int agreeing_neighbours = 5;
  /// The range grows from the histogram's peak over bins that hold this share of the matches (0 … 1); across
  /// a gap of more than gap_bins (0 … 100) this larger share; behind infinity, which real pairs rarely have
  /// but repeated patterns pretend, this one.
  double share = 0.001;
  int gap_bins = 6;
  double share_beyond_gap = 0.003;
  double share_behind_infinity = 0.03;
  /// The margin at each end, as a share of the range, for surfaces too plain to be matched in the reduced
  /// pair; 1/n with n from 1 … 1000.
  int far_margin_divisor = 4;
  int near_margin_divisor = 16;
};
std::vector<Parameter> parameters_of(RangeOptions& options);

/// The range of disparities from a reduced copy of the pair: each textured pixel's census signature is
/// searched along the whole scanline, in both directions; matches that are mutual and unique are counted in a
/// histogram, and the range is where the histogram exceeds the chance matches, which are spread evenly. Works
/// for disparities from minus to plus three quarters of the width. Both pictures of the same size, not empty.
DisparityRange find_disparity_range(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                    const RangeOptions& options, const Work& work);

}  // namespace palpable::vision
