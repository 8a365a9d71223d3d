// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

namespace palpable::models {

/// A signed distance in metres, negative inside the solid, and its gradient (of length near 1), in the frame
/// of the computation: that of a mesh, of a cloud of points, or of a leaf. What a touchable model returns is
/// a FieldSample.
struct DistanceSample {
  double distance_m = 0.0;
  Vec3 gradient;
};

}  // namespace palpable::models
