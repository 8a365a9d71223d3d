// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstddef>

namespace palpable::measure {

/// Undirected tangents of boundaries in any common axes: unit vectors, (0, 0) = none, with the boundary's
/// strength.
struct Directions {
  Raster<float> tangent_x;
  Raster<float> tangent_y;
  Raster<float> strength;
};

struct OrientationScoreOptions {
  /// A pixel counts if the truth has a direction and the result's strength is at least this share of its
  /// maximum; 0 ... 1.
  double least_strength = 0.8;
  /// Width of the picture's border that does not count, since filters extrapolate there; >= 0.
  int margin_px = 0;
};

struct OrientationScore {
  std::size_t pixels = 0;
  /// Angle between the two directions, 0 ... 90 degrees. NaN where no pixel counts.
  double max_deg = 0.0;
  double mean_deg = 0.0;
  double rms_deg = 0.0;
};

/// Angular errors of directions. If `truth` has strengths, only pixels whose strength is above 0 count.
/// Errors: invalid_input for sizes that differ, or if no pixel counts.
Result<OrientationScore> score_orientation(const Directions& result, const Directions& truth,
                                           const OrientationScoreOptions& options);

}  // namespace palpable::measure
