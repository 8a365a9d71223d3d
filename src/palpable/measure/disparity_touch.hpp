// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::measure {

/// Errors of a disparity map as a hand would feel them. Both maps become reliefs of one size: the picture's
/// longer side is 100 mm, and the truth's range over the scored pixels is 15 mm high.
struct DisparityTouch {
  /// Mean angle between the normals of both reliefs (plane fits of 5 x 5 pixels) where the truth is smooth,
  /// in degrees. NaN if it is smooth nowhere.
  double normal_error_deg = 0.0;
  /// Number of spurious steps per cm of path along rows and columns. A spurious step is a difference between
  /// neighbouring pixels that deviates from the truth's by more than 0.25 mm where the truth's is at most
  /// 0.25 mm.
  double spurious_steps_per_cm = 0.0;
  /// Length of that path.
  double path_cm = 0.0;
};

/// Only pixels count where both maps are known and the mask is white (255; empty = everywhere). Errors:
/// invalid_input for sizes that differ and for a truth of one value.
Result<DisparityTouch> touch_of_disparity(const Raster<float>& result_px, const Raster<float>& truth_px,
                                          const Raster<std::uint8_t>& mask = {});

}  // namespace palpable::measure
