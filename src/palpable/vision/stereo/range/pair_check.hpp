// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/stereo/range/disparity_range.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::vision {

/// The vertical offset of a pair, from up to two hundred distinctive pixels matched between the pictures.
struct VerticalOffset {
  /// Median of y_right - y_left, in steps of one pixel up to a width of 320, two up to 640 …; positive: the
  /// right picture's content lies lower.
  double median_px = 0.0;
  /// Third quartile of |y_right - y_left|, in pixels. Larger than median_px if the offset varies across the
  /// picture.
  double spread_px = 0.0;
  /// Number of matched pixels; below about 15 the figures are meaningless.
  int found = 0;
};

/// Searches offsets up to an eighth of the height. Both pictures of the same size.
VerticalOffset measure_vertical_offset(const Raster<std::uint8_t>& left, const Raster<std::uint8_t>& right,
                                       const Work& work);

/// Whether almost all disparities are negative, so that left and right seem to be exchanged.
bool looks_swapped(const DisparityRange& range);

/// When a pair gets a warning. Defaults are from the pairs in docs/stereo.md: six pictures of one scene agree
/// on 27 % and more. The agreement of unrelated real photographs has not been measured.
struct PairCheckOptions {
  /// Pictures that agree on less of their textured pixels may show different scenes. 0 … 1.
  double least_agreement = 0.08;
  /// Share of the pixels that must have texture. 0 … 1.
  double least_texture = 0.02;
  /// A pair with at least this share of measured depth shows one scene, whatever its agreement. 0 … 1.
  double enough_measured = 0.4;
  /// A share of guessed depth that is reported. 0 … 1.
  double most_guessed = 0.25;
  /// With less contrast_beyond_grain() a picture may be noise alone. 0 … 10.
  double only_grain = 0.5;
  /// A vertical offset is reported if this many pixels were matched and the offset's spread is at least this.
  /// 1 … 200; 0 … 100 px.
  int least_found = 15;
  double misaligned_px = 2.0;
  /// Measured disparities that differ by less feel flat. 0 … 100 px.
  double flat_px = 1.0;
};

std::vector<Parameter> parameters_of(PairCheckOptions& options);

/// Whether the pictures agree like two of one scene, from the search of the range and the matched depth.
bool agree(const DisparityRange& range, double measured, const PairCheckOptions& options = {});

/// The contrast of a copy reduced four times relative to the picture's own, each in windows of 9 x 7 pixels:
/// about 1/4 for camera noise alone, mostly above 1 for pictures of a real scene.
double contrast_beyond_grain(const Raster<std::uint8_t>& grey);

/// Warnings about a pair's depth for the user, one sentence each; empty for a good pair. `contrast` is the
/// left picture's contrast_beyond_grain(), `measured` the share of the pixels whose depth is measured
/// (confidence.hpp), `matched` the range in which it was sought: another one than `range` if the user chose
/// it.
std::vector<std::string> pair_notes(const DisparityRange& range, const DisparityRange& matched,
                                    const VerticalOffset& offset, double contrast, double measured,
                                    const PairCheckOptions& options = {});

/// A sentence for a pair whose measured disparities differ by only `spread_px` (5th to 95th percentile): one
/// picture given twice, or a camera that was not moved; nullopt if they differ enough.
std::optional<std::string> flat_note(double spread_px, const PairCheckOptions& options = {});

}  // namespace palpable::vision
