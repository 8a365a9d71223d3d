// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

namespace palpable::vision {

/// Half the side of the square over which matching costs are averaged; px.
inline constexpr int kMarginReach_px = 4;
/// Disparities that differ by at most this belong to one minimum; px.
inline constexpr int kSameMinimum_px = 2;
/// The mean cost of pixels that do not match, which a match outside the other picture gets.
inline constexpr float kUnlikeCost = 32.0F;

/// The matching costs (MatchingCost: census bits and levels, 0 … 83), averaged over 9 x 9 pixels.
struct MatchMargin {
  /// At the pixel's disparity.
  Raster<float> cost;
  /// The least cost of all other minima, less `cost`: large where one disparity alone matches, near 0 where
  /// many do (no texture, repeated patterns), negative where another one matches better. The range is
  /// searched, rounded up to whole vectors (whole_vectors()): in a narrow one, what lies beyond tells
  /// textures from plain areas.
  Raster<float> margin;
};

/// `disparity_px` is a result in the frame of `input`; where it is unknown, the match counts as outside the
/// picture. Does not depend on the number of threads. Memory: about 11 bytes for each column and disparity
/// and thread.
MatchMargin match_margin(const MatchInput& input, const Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
