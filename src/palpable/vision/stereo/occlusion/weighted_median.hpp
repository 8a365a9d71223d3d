// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <vector>

namespace palpable::vision {

struct WeightedMedianOptions {
  /// The window's reach to each side; px, 0 … 60.
  int reach_px = 14;
  /// Every n-th row and column of the window is used; px, 1 … 8.
  int step_px = 2;
  /// Colour difference at which a neighbour's weight falls by e; levels of 255, 1 … 255.
  float colour_levels = 8.0F;
  /// Distance (city block) at which a neighbour's weight falls by e; px, 1 … 200.
  float distance_px = 12.0F;
};
std::vector<Parameter> parameters_of(WeightedMedianOptions& options);

/// The weighted median of the disparities around each pixel; a neighbour's weight is its `trust` (0 = it does
/// not count) times factors for distance and colour difference. Plain surfaces are filled from all sides, and
/// occluded pixels take the disparity of similar colours. Integer disparities 0 … disparities - 1; a pixel
/// without weighted neighbours keeps its disparity. All rasters have the same size.
Raster<int> weighted_median(const ColourPlanes& picture, const Raster<int>& disparity_px,
                            const Raster<float>& trust, int disparities, const WeightedMedianOptions& options,
                            const Work& work);

}  // namespace palpable::vision
