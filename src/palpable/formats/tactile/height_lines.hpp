// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <optional>
#include <string>
#include <vector>

namespace palpable::formats {

struct HeightLineOptions {
  /// Height from one line to the next. > 0.
  double interval_m = 0.002;
  /// For objects on a flat ground: the first line is at this height and 1.5 times as wide; it is the objects'
  /// outline. The others are at multiples of the interval. Not given: lines are at (k + 1/2) intervals above
  /// the lowest height, and every fifth is 1.5 times as wide. > 0.
  std::optional<double> outline_m;
  /// Width of the black lines, which rise on swell paper. 0.05 … 10 mm.
  double line_width_m = 0.0008;
  /// Shorter lines are left out, since a finger does not find them. 0 … 0.1 m.
  double least_length_m = 0.0;
};

/// Lines of equal height in metres from the middle, y up, as drawings of dots need them; widths do not count.
/// Errors: as encode_height_lines().
Result<std::vector<Polyline>> height_polylines(const Raster<float>& heights_m, double pixel_m,
                                               const HeightLineOptions& options);

/// Lines of equal height as an SVG picture at true size, for swell paper; samples are `pixel_m` apart.
/// Errors: usage for an interval that would give more than 200 lines, and for options out of range.
Result<std::string> encode_height_lines(const Raster<float>& heights_m, double pixel_m,
                                        const HeightLineOptions& options);

}  // namespace palpable::formats
