// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstdint>

namespace palpable::vision {

/// The input of every stereo method: the pair prepared once by match(). Both pictures have the same size, at
/// least kMinStereoSide on each side; their exposures are matched and the levels stretched to 0…255.
struct MatchInput {
  Raster<Rgb8> left;
  Raster<Rgb8> right;
  Raster<std::uint8_t> left_grey;
  Raster<std::uint8_t> right_grey;
  /// Disparities 0 … disparities - 1 are searched, x_right = x_left - d; at least 2. If the real range begins
  /// elsewhere, match() has shifted the right picture and repeated its border columns.
  int disparities = 0;
  /// The right picture has content from this column on.
  int right_first = 0;
};

inline constexpr int kMinStereoSide = 8;

/// A method's result in the frame of MatchInput, of the left picture's size.
struct MatchOutput {
  Raster<float> disparity_px;
  /// 1 where both views agree within a pixel (left_right_check()), else 0; empty if the method has one view
  /// only.
  Raster<float> confirmed;
};

}  // namespace palpable::vision
