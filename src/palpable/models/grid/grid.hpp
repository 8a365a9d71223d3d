// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/grid/occupancy_grid.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>

namespace palpable::models {

/// A volume as a touchable model: its occupied points, and the relief under which they were filled, for
/// planar devices and for pictures. Immutable.
struct Grid {
  OccupancyGrid occupancy;
  /// Never null.
  std::shared_ptr<const Relief> from_above;

  std::size_t memory_bytes() const { return occupancy.memory_bytes() + from_above->memory_bytes(); }
};

}  // namespace palpable::models
