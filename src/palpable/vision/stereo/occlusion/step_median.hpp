// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <vector>

namespace palpable::vision {

/// How steps of disparity are moved to edges of colour.
struct StepMedianOptions {
  /// Number of medians; 0 … 10.
  int rounds = 1;
  /// A step is a difference between neighbours above this; px, 0.1 … 100.
  float least_step_px = 1.0F;
  /// The window's reach to each side, and the distance from a step within which pixels are changed; px, 1 …
  /// 60.
  int reach_px = 8;
  /// Every n-th row and column of the window is used; px, 1 … 8.
  int every_px = 2;
  /// Colour difference at which a neighbour's weight falls by e; levels of 255, 1 … 255.
  float colour_levels = 10.0F;
  /// A pixel keeps its disparity if this share of the weights, or more, is within 1 px of it (so thin objects
  /// and leaves are kept; 1: the median alone decides); 0 … 1.
  float enough_support = 0.3F;
  /// A pixel keeps its disparity if the median differs by this or less; px, 0 … 100.
  float least_change_px = 0.75F;
};
std::vector<Parameter> parameters_of(StepMedianOptions& options);

/// Moves steps of disparity to edges of colour. A window that contains an edge matches at the nearer
/// surface's disparity, so nearer surfaces reach a few pixels beyond their edge into a plain background. Near
/// a step, each pixel takes the median of the disparities around it, weighted by similar colour (Ma, He, Wei,
/// Sun & Wu 2013, "Constant time weighted median filtering for stereo matching and beyond"). Away from steps,
/// and where the median confirms the disparity, nothing changes, so slopes and sub-pixel disparities are
/// kept. All disparities are finite. The result does not depend on the number of threads.
void median_at_steps(const ColourPlanes& colour, const StepMedianOptions& options,
                     Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
