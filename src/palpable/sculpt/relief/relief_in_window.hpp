// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/sculpt/relief/relief_shape.hpp"
#include "palpable/vision/depth_camera/depth_range.hpp"

namespace palpable::sculpt {

struct WindowedReliefOptions {
  /// Greatest width and depth, and the height of near_m above far_m; each 1 mm ... 1 m.
  Vec3 size_m = kDefaultReliefSize_m;
  /// No place becomes steeper (rise over run), 0.1 ... 100: the tops of steps are cut, at a quarter of the
  /// cost of models::limit_slope().
  double steepest_slope = 3.0;
};

/// A relief of the depths of `range` (0 < near_m < far_m): nearer ones are clamped, farther and unknown ones
/// are at the base. Its heights depend on each pixel's own depth only, linearly, whatever the other pixels
/// show: so the relief of a scene at rest stays where it is from frame to frame of a live source, which
/// relief_from_depth() does not promise. Errors: usage for options out of range or an empty range;
/// invalid_input for fewer than 2 x 2 pixels.
Result<models::Relief> relief_in_window(const Raster<float>& depth_m, const vision::DepthRange& range,
                                        const WindowedReliefOptions& options);

}  // namespace palpable::sculpt
