// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

struct SolidOptions {
  /// Thickness below the relief's base, z = 0.
  double base_plate_m = 0.002;
};

/// The relief as a closed body for printing and display: its surface (a vertex at every sample, at the
/// spline's height), vertical sides, and a flat bottom at z = -base_plate_m. Its outer size is exactly the
/// relief's. Vertices have texture coordinates in the relief's picture.
Mesh solid_of(const Relief& relief, const SolidOptions& options = {});

}  // namespace palpable::models
