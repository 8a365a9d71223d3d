// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

namespace palpable::vision {

struct VoteOptions {
  /// Pixels to each side, and of these every so-manieth votes.
  int reach_px = 14;
  int step_px = 2;
  /// A neighbour's vote falls by e with so many levels (of 255) of colour difference, and with so many
  /// pixels.
  float colour_levels = 8.0F;
  float distance_px = 12.0F;
};

/// Gives each pixel the median of the disparities around it, weighted by `trust` (0 = does not
/// vote) and by how near and alike the pixels are: surfaces of one colour are filled
/// from all sides, and what is hidden takes the disparity of what it looks like. Whole disparities 0 …
/// disparities - 1; pixels around which nobody votes keep theirs. All sizes alike.
Raster<int> voted(const ColourPlanes& picture, const Raster<int>& disparity_px, const Raster<float>& trust,
                  int disparities, const VoteOptions& options, const Work& work);

}  // namespace palpable::vision
