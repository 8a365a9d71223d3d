// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <span>

namespace palpable::sculpt {

/// A plane n·p = offset, n a unit vector.
struct Plane {
  Vec3 normal{0.0, 0.0, 1.0};
  double offset_m = 0.0;

  double height_m(Vec3 p) const { return dot(normal, p) - offset_m; }
};

/// The plane with the least sum of squared distances to the points (principal components): its normal is the
/// direction of their smallest variance, of undetermined sign; (0, 0, 1) if all points are in one place. The
/// points must be finite, at least one.
Plane plane_through(std::span<const Vec3> points_m);

}  // namespace palpable::sculpt
