// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <optional>

namespace palpable::measure {

/// Compares a relief with the depth that it was made from, by what a hand would miss or misread
/// (docs/relief.md). In the scene's own proportions the depth is `compression` times higher than the relief.
struct ReliefScoreOptions {
  double compression = 10.0;
  /// Height of the scene in its own proportions, for a relief that does not use its whole intended height.
  /// Not given: compression times the relief's height.
  std::optional<double> scene_height_m;
  /// The relief's slope limit. Depth steps of more than twice this slope, in the scene's own proportions, are
  /// silhouettes.
  double steepest_slope = 3.0;
  /// Least height of a detail in the scene's own proportions, and least height on the relief at which it can
  /// be felt: the resolution of affordable devices (docs/relief.md).
  double detail_m = 0.0002;
  double felt_m = 0.00004;
};

struct ReliefScore {
  /// Percent of the pixels away from silhouettes with a reversed slope: both slopes above 1 : 50, and more
  /// than a right angle apart.
  double reversed_slopes_percent = 0.0;
  /// Local correlation of the detail bands (forms of 1 ... 3 pixels) away from silhouettes, in Gaussian
  /// windows of 8 pixels' standard deviation, weighted by the truth's detail; -1 ... 1. NaN if there is no
  /// detail.
  double detail_correlation = 0.0;
  /// Percent of the pixel pairs across a depth step (4 pixels apart, more than 5 % of the range) whose order
  /// is reversed or equal on the relief. NaN if there is no step.
  double wrong_order_percent = 0.0;
  double greatest_slope = 0.0;
  /// Percent of the details (extremes of the detail band) that can still be felt. NaN if there are none.
  double details_kept_percent = 0.0;
  std::size_t details = 0;
  std::size_t depth_steps = 0;

  /// Sum of the errors in percent, 0 is perfect: reversed slopes, missing correlation, wrong order and lost
  /// details.
  double sum() const;
};

/// `height_m`: the relief's samples. `nearness`: the depth, greater is nearer, in any linear unit, of the
/// same size; NaN = unknown, not scored. Errors: invalid_input for sizes that differ, fewer than 16 x 16
/// pixels, or a truth of one level.
Result<ReliefScore> score_relief(const Raster<float>& height_m, double pixel_m, const Raster<float>& nearness,
                                 const ReliefScoreOptions& options);

}  // namespace palpable::measure
