// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cstdint>

namespace palpable::vision {

/// What every stereo method gets: the pair prepared once by match(). Both pictures have the same size, at
/// least kMinStereoSide on each side; their exposures are levelled and the levels stretched to 0…255.
struct MatchInput {
  Raster<Rgb8> left;
  Raster<Rgb8> right;
  Raster<std::uint8_t> left_grey;
  Raster<std::uint8_t> right_grey;
  /// Disparities 0 … disparities - 1 are searched, x_right = x_left - d; at least 2. Where the real range
  /// begins elsewhere, match() has shifted the right picture, its border columns repeated.
  int disparities = 0;
  /// The right picture shows something from this column on.
  int right_first = 0;
};

inline constexpr int kMinStereoSide = 8;

/// A method's answer in the frame of MatchInput; sizes as the left picture's, confidence may be empty.
struct MatchOutput {
  Raster<float> disparity_px;
  Raster<float> confidence;
};

}  // namespace palpable::vision
