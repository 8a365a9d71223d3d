// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::measure {

/// What a hand would feel wrong of a disparity map. Both maps are taken as reliefs of one size: the longer
/// side of the picture is 100 mm, the truth's range over the scored pixels 15 mm high.
struct DisparityTouch {
  /// Mean angle between the two reliefs' normals, in degrees, where the truth is smooth; slopes over 5 x 5
  /// pixels. NaN where there is no such place.
  double normal_error_deg = 0.0;
  /// Steps between neighbouring pixels that rise or fall by more than 0.25 mm against the truth's own step,
  /// which itself is smaller, for each cm of path along the rows and down the columns.
  double spurious_steps_per_cm = 0.0;
  /// How long that path is.
  double path_cm = 0.0;
};

/// Only places where both maps are known, and the mask is white (255; empty = everywhere), count. Errors:
/// invalid_input for sizes that differ, for a truth without range.
Result<DisparityTouch> touch_of_disparity(const Raster<float>& result_px, const Raster<float>& truth_px,
                                          const Raster<std::uint8_t>& mask = {});

}  // namespace palpable::measure
