// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/models/relief/relief.hpp"

#include <optional>

namespace palpable::models {

/// The nearest point of a surface.
struct ClosestPoint {
  Point<SceneFrame> surface;
  /// Euclidean distance in metres, negative under the surface.
  double distance_m = 0.0;
  /// The surface's outward unit normal there.
  Vector<SceneFrame> normal;
};

/// The point of the relief's surface nearest to `p`, by bounds over the spline's cells and Newton's method:
/// accurate to 1e-8 m. Not for the tick: it takes tens of microseconds, more for distant points.
/// nullopt if `p` is not finite or is outside the relief's rectangle (seen from above).
std::optional<ClosestPoint> closest_point(const Relief& relief, Point<SceneFrame> p);

}  // namespace palpable::models
