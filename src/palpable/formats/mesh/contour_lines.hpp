// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

#include <string>

namespace palpable::formats {

struct ContourLineOptions {
  /// Height from one line to the next; the lines stand at (k + 1/2) times this above the lowest place. > 0.
  double interval_m = 0.002;
  /// Black lines of this width rise on swell paper; every fifth is half as wide again.
  double line_width_m = 0.0008;
};

/// The relief's lines of equal height as an SVG picture at true size, for swell paper. Errors: usage for an
/// interval that would give more than 200 lines, or a width out of 0.05 ... 10 mm.
Result<std::string> encode_contour_lines(const models::Relief& relief, const ContourLineOptions& options);

}  // namespace palpable::formats
