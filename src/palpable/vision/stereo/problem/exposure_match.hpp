// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

// Brightness of a pair's pictures, and histogram matching of the right picture to the left one.
namespace palpable::vision {

inline constexpr std::size_t kQuantiles = 256;
/// The levels at the quantiles 0, 1/255 … 1.
using Quantiles = std::array<float, kQuantiles>;

/// The luma's quantiles over thousands of pixels; all 0 if none is finite.
Quantiles luma_quantiles(const Image& image);

/// Maps levels of one picture onto another's, by a monotone curve through their quantiles.
class LevelCurve {
 public:
  /// Leaves levels as they are.
  LevelCurve() = default;
  /// If `from` is clipped (at its darkest or brightest level lie at least `clipped_quantiles` more quantiles
  /// than at that of `to`), these levels are mapped to the level where clipping begins, and clip() limits
  /// `to` to it.
  LevelCurve(const Quantiles& from, const Quantiles& to, int clipped_quantiles);

  /// A level of `from` as a level of `to`.
  float operator()(float level) const;
  /// A level of `to`, limited to the range that the other picture has.
  float clip(float level) const { return level < least_ ? least_ : level > most_ ? most_ : level; }

 private:
  bool identity_ = true;
  Quantiles from_{}, to_{};
  float least_ = -std::numeric_limits<float>::infinity();
  float most_ = std::numeric_limits<float>::infinity();
};

/// Preparation of a pair's pictures for matching.
struct PreparationOptions {
  /// The exposures differ if the middle parts of the histograms differ by more than this share of their used
  /// range (mean over the quantiles); 0 … 1.
  double exposure_difference = 0.08;
  /// The first of the 256 quantiles of the middle part: the ends depend on surfaces that only one of the
  /// cameras sees; 0 … 127.
  int compared_first = 26;
  /// The last one; 128 … 255.
  int compared_last = 230;
  /// A picture is clipped if this many more of its 256 quantiles than of the other's lie at one end of its
  /// levels; 1 … 128.
  int clipped_quantiles = 3;
  /// 8-bit pictures that use a smaller range of levels than this are stretched, as deeper ones always are; 0
  /// … 1.
  double stretch_below = 0.4;
  /// A line belongs to a dark frame if its mean is below this share of the next inner line's mean; 0 … 1.
  double frame_darkness = 0.6;
  /// A frame takes at most this share of a side, as 1/n; n from 2 … 1000.
  int frame_divisor = 60;
};
std::vector<Parameter> parameters_of(PreparationOptions& options);

/// The exposure difference of a pair.
struct Exposure {
  /// Whether the right picture's levels are mapped to the left one's.
  bool differs = false;
  /// Median of the right picture's levels divided by that of the left one's.
  double brightness_ratio = 1.0;
  /// Shares of each picture's pixels at its own brightest level, 0 … 1.
  double left_clipped = 0.0, right_clipped = 0.0;
};

/// The mapping of the right picture's levels to the left one's: one curve each for red, green and blue (a
/// picture of one channel uses the first), which also corrects white balance.
struct ExposureMatch {
  Exposure exposure;
  std::array<LevelCurve, 3> curves;
};

/// Compares two pictures of the same size. The curves are the identity if the exposures agree.
ExposureMatch match_exposures(const Image& left, const Image& right, const PreparationOptions& options);

/// One sentence with the figures, for a pair whose exposures differ.
std::string sentence_of(const Exposure& exposure);

}  // namespace palpable::vision
