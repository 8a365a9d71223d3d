// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"

namespace palpable::sculpt {

/// Width, height and depth that bound a relief whose size is not given, metres.
inline constexpr Vec3 kDefaultReliefSize_m{0.10, 0.10, 0.015};

/// Errors: usage for a side that is not 1 mm ... 1 m, or a steepest slope (rise over run) that is not
/// 0.1 ... 100.
Result<void> check_relief_shape(Vec3 size_m, double steepest_slope);

}  // namespace palpable::sculpt
