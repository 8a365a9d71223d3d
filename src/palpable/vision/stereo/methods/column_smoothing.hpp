// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

struct ColumnOptions {
  /// Rows above and below that vote, and columns beside; px, 1 … 60 and 0 … 10.
  int reach_px = 10;
  int half_width_px = 1;
  /// A neighbour's weight falls with its distance and by e with this colour difference; levels of 255, mean
  /// of the channels, 1 … 255.
  float colour_levels = 10.0F;
  /// The weight of an untrusted pixel; 0.001 … 1.
  float untrusted_weight = 0.05F;
  /// Disparities that differ by at most this support each other; px, 0.1 … 10.
  float support_px = 1.0F;
  /// A disparity is an outlier when less than this share of the weights supports it; 0 … 1 …
  float outlier_share = 0.4F;
  /// … and so are its neighbours along the scanline with its disparity, when less than this share does; 0
  /// … 1.
  float streak_share = 0.6F;
};
std::vector<Parameter> parameters_of(ColumnOptions& options);

/// Removes the streaks of independent scanline matching and keeps edges (Shi & Pai 1997, section 3.3): a
/// disparity in the tail of its column's distribution is replaced by the weighted mean of the inliers, and so
/// are its neighbours along the scanline with the same disparity. `disparity_px`: no NaN; all rasters have
/// the same size.
void smooth_columns(const Raster<Rgb8>& picture, const Raster<std::uint8_t>& trusted,
                    const ColumnOptions& options, Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
