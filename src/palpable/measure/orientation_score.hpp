// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>

namespace palpable::measure {

/// Directions without a sign, in any axes that both sides share: unit tangents, (0, 0) = none, and how
/// strong the boundary is there.
struct Directions {
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  Raster<float> strength;
};

struct OrientationScoreOptions {
  /// A pixel counts where the truth has a direction and the result is at least so strong, as a share of its
  /// greatest strength; 0 ... 1.
  double least_strength = 0.8;
  /// Pixels so near the picture's border do not count: filters see what is not there. >= 0.
  int margin_px = 0;
};

struct OrientationScore {
  std::size_t pixels = 0;
  /// Angle between the two directions, 0 ... 90 degrees. NaN where no pixel counts.
  double max_deg = 0.0;
  double mean_deg = 0.0;
  double rms_deg = 0.0;
};

/// How far directions are from the true ones. Where `truth` has strengths, only those above 0 count. Errors:
/// invalid_input for sizes that differ, or where no pixel counts.
Result<OrientationScore> score_orientation(const Directions& result, const Directions& truth,
                                           const OrientationScoreOptions& options);

}  // namespace palpable::measure
