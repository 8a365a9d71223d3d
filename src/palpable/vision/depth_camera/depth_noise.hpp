// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

namespace palpable::vision {

/// Standard deviation of a depth camera's reading at depth z: floor_m + per_m2 * z^2. The defaults are those
/// that Khoshelham and Elberink (2012) measured for a camera with structured light, 1.4 mm at 1 m, and half a
/// millimetre for files that hold whole millimetres.
struct DepthNoise {
  /// 0 ... 0.1.
  double floor_m = 0.0005;
  /// 0 ... 0.1, 1/m.
  double per_m2 = 0.0014;

  float deviation_m(float z_m) const {
    return static_cast<float>(floor_m) + static_cast<float>(per_m2) * z_m * z_m;
  }
};

/// Errors: usage for a value outside its range.
Result<void> check(const DepthNoise& noise);

}  // namespace palpable::vision
