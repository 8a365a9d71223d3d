// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>
#include <optional>

namespace palpable::measure {

/// What a hand would miss or be misled by on a relief, against the depth that it was made from
/// (docs/relief.md). The depth in the scene's own proportions is `compression` times higher than the relief.
struct ReliefScoreOptions {
  double compression = 10.0;
  /// Of the scene in its own proportions, where the relief does not use the whole height that it was meant to
  /// have. Not given: compression times the relief's height.
  std::optional<double> scene_height_m;
  /// Of the relief; depth steps of more than twice this slope, in the scene's own proportions, are
  /// silhouettes.
  double steepest_slope = 3.0;
  /// A detail is at least so high in the scene's own proportions, and felt where it is at least so high on
  /// the relief: the resolution of affordable devices (docs/relief.md).
  double detail_m = 0.0002;
  double felt_m = 0.00004;
};

struct ReliefScore {
  /// Percent of the pixels away from silhouettes whose slope leads the hand the wrong way: both slopes above
  /// 1 : 50, and more than a right angle apart.
  double reversed_slopes_percent = 0.0;
  /// How alike the forms of 1 ... 3 pixels are: local correlation (windows of 8 pixels' standard deviation)
  /// of the detail bands, away from silhouettes, weighed by the truth's detail; -1 ... 1. NaN where there is
  /// no detail.
  double detail_correlation = 0.0;
  /// Percent of the pixel pairs across a depth step (4 pixels apart, more than 5 % of the range) that stand
  /// in the wrong order or level. NaN where there is no step.
  double wrong_order_percent = 0.0;
  double greatest_slope = 0.0;
  /// Percent of the details (extremes of the detail band) that can still be felt. NaN where there are none.
  double details_kept_percent = 0.0;
  std::size_t details = 0;
  std::size_t depth_steps = 0;

  /// The measures as one number, 0 is perfect: percentages of reversed slopes, of correlation lacking, of
  /// wrong order and of details lost.
  double sum() const;
};

/// `height_m`: the relief's samples. `nearness`: the depth, greater is nearer, in any linear unit, of the
/// same size; NaN = unknown, not scored. Errors: invalid_input for sizes that differ, fewer than 16 x 16
/// pixels, or a truth of one level.
Result<ReliefScore> score_relief(const Raster<float>& height_m, double pixel_m, const Raster<float>& nearness,
                                 const ReliefScoreOptions& options);

}  // namespace palpable::measure
