// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/range/plain_runs.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

/// A pair's range of disparities in pixels with a margin, and the agreement of its pictures.
struct DisparityRange {
  int min_px = 0;
  int max_px = 0;
  /// Fraction of the textured pixels whose best match is mutual: 0…1. Pictures of one scene give 0.3 and
  /// more, unrelated ones below 0.1.
  double agreement = 0.0;
  /// Fraction of pixels with enough texture to be matched.
  double textured = 0.0;
};

/// Parameters of find_disparity_range().
struct RangeOptions {
  /// The pair is reduced by a whole factor to about this width; px, 32 … 2048.
  int coarse_width_px = 224;
  /// Rows of it that are matched; 8 … 2048.
  int rows = 64;
  /// Least margin to the next best match elsewhere, census bits; 0 … 63.
  int unique_bits = 3;
  /// Least number of agreeing matches (within a pixel) among those within two columns and one row, itself
  /// included; 1 … 15.
  int agreeing_neighbours = 5;
  /// The range grows from the histogram's peak over bins that hold this share of the matches (0 … 1); beyond
  /// a gap of more than gap_bins (0 … 100) a larger share; and for negative disparities, which are rare in
  /// real pairs but common false matches of repeated patterns, another one.
  double share = 0.001;
  int gap_bins = 6;
  double share_beyond_gap = 0.003;
  double share_behind_infinity = 0.03;
  /// The margin at each end, as a share of the range, for surfaces too plain to be matched in the reduced
  /// pair; 1/n with n from 1 … 1000.
  int far_margin_divisor = 4;
  int near_margin_divisor = 16;
  /// If less than this share of the picture has texture, the far end moves towards 0 in proportion: what has
  /// none is not matched here; 0.01 … 1.
  double enough_texture = 0.5;
  /// A surface of one colour beyond the near end moves that end if it covers this share of the picture; 0
  /// … 1.
  double plain_share = 0.005;
  PlainRunOptions plain = {};
};
std::vector<Parameter> parameters_of(RangeOptions& options);

/// The range of disparities from a reduced copy of the pair: each textured pixel's census signature is
/// searched along the whole scanline, in both directions; matches that are mutual and unique are counted in a
/// histogram, and the range is where the histogram exceeds the chance matches, which are spread evenly; its
/// near end is moved to the surfaces of one colour that plain_run_disparities() finds beyond it. Works for
/// disparities from minus to plus three quarters of the width. Both pictures have the same size and are not
/// empty.
DisparityRange find_disparity_range(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                    const RangeOptions& options, const Work& work);

}  // namespace palpable::vision
