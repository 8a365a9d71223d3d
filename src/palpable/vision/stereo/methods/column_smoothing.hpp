// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo_method.hpp"

namespace palpable::vision {

struct ColumnOptions {
  /// Rows above and below that vote, and columns beside.
  int reach_px = 10;
  int half_width_px = 1;
  /// A neighbour's vote falls with its distance and with its difference of colour (levels of 255, mean of
  /// channels).
  float colour_levels = 10.0F;
  /// An untrusted pixel's vote counts only so much.
  float untrusted_vote = 0.05F;
  /// A disparity is an outlier when less than this share of the votes lies within one pixel of it …
  float outlier_share = 0.4F;
  /// … and its neighbours along the scanline, when they are alike and have less than this.
  float streak_share = 0.6F;
};

/// Removes the streaks that matching each scanline by itself leaves, and keeps edges (Shi & Pai 1997,
/// section 3.3): a disparity in the tail of its column's distribution is replaced by the weighted mean of the
/// reasonable ones; so are its neighbours along the scanline that share its disparity. `disparity_px`: no
/// NaN; all sizes alike.
void smooth_columns(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& trusted,
                    const ColumnOptions& options, Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
