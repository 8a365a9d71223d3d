// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/axis_direction.hpp"

namespace palpable {

/// The length of one coordinate unit.
enum class LengthUnit { unknown, metre };

/// What a file format defines about the coordinates of a solid.
struct CoordinateConvention {
  AxisDirection up = AxisDirection::plus_y;
  LengthUnit unit = LengthUnit::unknown;
};

}  // namespace palpable
