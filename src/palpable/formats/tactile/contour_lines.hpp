// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <optional>
#include <string>

namespace palpable::formats {

struct ContourLineOptions {
  /// Height from one line to the next. > 0.
  double interval_m = 0.002;
  /// Heights above a flat ground: a first line at this height, half as wide again, is the objects' outline,
  /// and the others lie at multiples of the interval. Nothing: the lines lie at (k + 1/2) intervals above the
  /// lowest place, and every fifth is half as wide again. > 0.
  std::optional<double> outline_m;
  /// Black lines of this width rise on swell paper. 0.05 … 10 mm.
  double line_width_m = 0.0008;
  /// Shorter lines are left out: a finger does not find them. 0 … 0.1 m.
  double least_length_m = 0.0;
};

/// Lines of equal height as an SVG picture at true size, for swell paper; samples are `pixel_m` apart.
/// Errors: usage for an interval that would give more than 200 lines, and for options out of range.
Result<std::string> encode_contour_lines(const Raster<float>& heights_m, double pixel_m,
                                         const ContourLineOptions& options);

}  // namespace palpable::formats
