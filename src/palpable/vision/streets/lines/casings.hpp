// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <vector>

namespace palpable::vision {

struct CasingOptions {
  /// A casing is darker than the street and than what is beside it by at least this much, grey levels. 0 ...
  /// 255.
  double least_contrast = 8.0;
  /// Beside land that is darker than the street by this much, a casing cannot be seen: the border counts as
  /// one, grey levels. 0 ... 255.
  double dark_land = 40.0;
  /// The street is what is this far inside of its border, pixels. 0 ... 20.
  double inside_px = 2.0;
  /// Its casing lies from this far inside of its border to this far outside, pixels. 0 ... 20 each.
  double casing_inside_px = 1.0;
  double casing_outside_px = 2.0;
  /// What is beside it is at both of these distances from its border, pixels: lettering may cover one of
  /// them. 0 ... 50 each.
  double beside_px = 3.0;
  double far_beside_px = 4.5;
  /// Every such point of a line is looked at, and its direction is that of this many points on both sides. 1
  /// ... 20 each.
  int step_points = 2;
  int direction_points = 3;
  /// A map draws its streets with casings if this part of their length has them. 0 ... 1.
  double least_cased_part = 0.7;
  /// On such a map, a line that has a casing on less than this part of its length is no street. 0 ... 1.
  double least_line_part = 0.15;
  /// And so is one that has a casing on less than this part of one of its sides: the rim of an area. 0 ... 1.
  double least_side_part = 0.15;
};
std::vector<Parameter> parameters_of(CasingOptions& options);

/// Parts of a line's length, 0 ... 1, on which a thin darker line, or land that is much darker, bounds the
/// street: on its left side, on its right one (what is outside of the picture counts for these), and on at
/// least one of them.
struct CasedParts {
  double left = 0.0;
  double right = 0.0;
  double any = 0.0;
};

/// Any thread.
CasedParts cased_parts(const Raster<Rgb8>& picture, const CentreLine& line,
                       const CasingOptions& options = {});

}  // namespace palpable::vision
