// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_shape.hpp"

namespace palpable::sculpt {

Result<void> check_relief_shape(Vec3 size_m, double steepest_slope) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  for (const double side : {size_m.x, size_m.y, size_m.z})
    if (!(side >= 0.001 && side <= 1.0)) return usage("the size's sides must be 1 to 1000 mm");
  if (!(steepest_slope >= 0.1 && steepest_slope <= 100.0))
    return usage("the steepest slope must be 0.1 to 100");
  return {};
}

}  // namespace palpable::sculpt
