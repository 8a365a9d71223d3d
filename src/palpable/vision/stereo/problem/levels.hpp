// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/image.hpp"

#include <array>
#include <cstddef>
#include <limits>
#include <string>

// How bright the pictures of a pair are, and how the right one's levels become the left one's.
namespace palpable::vision {

inline constexpr std::size_t kQuantiles = 256;
/// The levels at the quantiles 0, 1/255 … 1.
using Quantiles = std::array<float, kQuantiles>;

/// Of a picture's luma, over thousands of its pixels; all 0 where none is finite.
Quantiles luma_quantiles(const Image& image);

/// Maps levels of one picture onto another's, by a monotone curve through their quantiles.
class LevelCurve {
 public:
  /// Leaves levels as they are.
  LevelCurve() = default;
  /// Where `from` is clipped (many pixels at its darkest or brightest level) and `to` is not, what `to` has
  /// beyond was lost: such levels are mapped to where the loss begins, and clip() brings `to` there too.
  LevelCurve(const Quantiles& from, const Quantiles& to);

  /// A level of `from` as a level of `to`.
  float operator()(float level) const;
  /// A level of `to` without what the other picture has lost.
  float clip(float level) const { return level < least_ ? least_ : level > most_ ? most_ : level; }

 private:
  bool identity_ = true;
  Quantiles from_{}, to_{};
  float least_ = -std::numeric_limits<float>::infinity();
  float most_ = std::numeric_limits<float>::infinity();
};

/// How the exposures of a pair differ.
struct Exposure {
  /// Whether it is enough to level the right picture.
  bool differs = false;
  /// The middle of the right picture's levels over the middle of the left one's.
  double brightness_ratio = 1.0;
  /// Shares of each picture's pixels at its own brightest level, 0 … 1.
  double left_clipped = 0.0, right_clipped = 0.0;
};

/// What levels a pair: one curve for each of red, green and blue (a picture of one channel uses the first),
/// which evens out white balance too.
struct Levelling {
  Exposure exposure;
  std::array<LevelCurve, 3> curves;
};

/// Looks at a pair of pictures of the same size. The curves change nothing where the exposures agree.
Levelling levelling_of(const Image& left, const Image& right);

/// One sentence with the figures, for a pair whose exposures differ.
std::string sentence_of(const Exposure& exposure);

}  // namespace palpable::vision
