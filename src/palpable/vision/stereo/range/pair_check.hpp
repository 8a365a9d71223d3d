// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/range/disparity_range.hpp"

#include <string>
#include <vector>

namespace palpable::vision {

/// How far one picture lies above the other, from up to two hundred distinct pixels found again in the other
/// picture.
struct VerticalOffset {
  /// Median of y_right - y_left, in steps of one pixel up to a width of 320, two up to 640 …; positive: the
  /// right picture's content lies lower.
  double median_px = 0.0;
  /// Three quarters of the pixels lie within this of the scanline they should be on, in pixels. Above
  /// median_px where the offset rolls across the picture.
  double spread_px = 0.0;
  /// Pixels found again; below about 15 the figures mean nothing.
  int found = 0;
};

/// Searches offsets up to an eighth of the height. Both pictures of the same size.
VerticalOffset measure_vertical_offset(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                       const Work& work);

/// The disparities lie behind infinity as a whole: left and right were exchanged.
bool looks_swapped(const DisparityRange& range);

/// Whether the pictures agree as two of one scene do.
bool agree(const DisparityRange& range);

/// The contrast of a copy of the picture four times smaller over its own, each within windows of 9 x 7
/// pixels: a quarter where there is nothing but a camera's grain, mostly above 1 in pictures of a real scene.
double contrast_beyond_grain(const Raster<std::uint8_t>& grey);
/// Below this there may be nothing but grain.
inline constexpr double kOnlyGrain = 0.5;

/// What the person should know about a pair before trusting its depth, one sentence each; empty for a good
/// pair. `contrast` is the left picture's contrast_beyond_grain().
std::vector<std::string> pair_notes(const DisparityRange& range, const VerticalOffset& offset,
                                    double contrast);

}  // namespace palpable::vision
