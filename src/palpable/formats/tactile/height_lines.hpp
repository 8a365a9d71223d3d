// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::formats {

struct HeightLineOptions {
  /// Height from one line to the next. > 0.
  double interval_m = 0.002;
  /// For objects on a flat ground: the first line is at this height and 1.5 times as wide; it is the objects'
  /// outline. The others are at multiples of the interval. Not given: lines are at (k + 1/2) intervals above
  /// the lowest height, and every fifth is 1.5 times as wide. > 0.
  std::optional<double> outline_m;
  /// Shorter lines are left out, since a finger does not find them. 0 … 0.1 m.
  double least_length_m = 0.0;
  /// Heights are averaged over about this width before, so that lines have no detail that is finer. 0: as
  /// they are. 0 … 0.1 m.
  double smooth_m = 0.0;
  /// Beyond the raster's border nothing is known, so that lines end there; or there is nothing but the lowest
  /// height, so that lines go on along it.
  enum class Beyond : std::uint8_t { unknown, lowest };
  Beyond beyond = Beyond::unknown;
};

/// A line of equal height: metres from the middle, y up.
struct HeightLine {
  Polyline line;
  /// Of the width of the others.
  double weight = 1.0;
};

/// Lines of equal height, samples `pixel_m` apart: the wider ones first, then the longer ones. Errors: usage
/// for an interval that would give more than 200 lines, and for options out of range.
Result<std::vector<HeightLine>> height_lines(const Raster<float>& heights_m, double pixel_m,
                                             const HeightLineOptions& options);

}  // namespace palpable::formats
