// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/distance_surface.hpp"
#include "palpable/sculpt/box.hpp"

#include <cstdint>

namespace palpable::sculpt {

/// A solid that knows its exact distance: what a distance field is sampled from (a mesh, superquadrics, a
/// relief, points). Any thread.
class DistanceSource {
 public:
  DistanceSource() = default;
  DistanceSource(const DistanceSource&) = delete;
  DistanceSource& operator=(const DistanceSource&) = delete;
  virtual ~DistanceSource() = default;

  /// A source's own memory from one call to the next, a start for places near each other. New at first, one
  /// for each thread.
  struct Hint {
    std::uint32_t triangle = 0;
    /// The last place and its distance (0: none yet): nearer to it than that, nothing changes its side.
    Vec3 place_m;
    double distance_m = 0.0;
  };

  /// Euclidean distance to the surface at any finite place, negative inside, and its gradient: a unit vector
  /// (on edges and medial sheets that of one side).
  virtual models::FieldSample at(Vec3 place_m, Hint& hint) const = 0;
  /// Of the solid's surface.
  virtual Box bounds() const = 0;
};

}  // namespace palpable::sculpt
