// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/axis_direction.hpp"

namespace palpable {

/// What one unit of some coordinates is.
enum class LengthUnit { unknown, metre };

/// What a file format says about the coordinates of its solids.
struct CoordinateConvention {
  AxisDirection up = AxisDirection::plus_y;
  LengthUnit unit = LengthUnit::unknown;
};

}  // namespace palpable
