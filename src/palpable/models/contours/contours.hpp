// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/contours/boundary_map.hpp"
#include "palpable/models/relief/relief.hpp"

#include <memory>

namespace palpable::models {

/// A picture's contours as a touchable model: its boundary map (law `tracing`), and the same lines as grooves
/// in a plate of the same size (laws `groove` and `rolling`). Immutable.
struct Contours {
  BoundaryMap boundaries;
  /// Never null.
  std::shared_ptr<const Relief> grooves;

  std::size_t memory_bytes() const { return boundaries.memory_bytes() + grooves->memory_bytes(); }
};

}  // namespace palpable::models
