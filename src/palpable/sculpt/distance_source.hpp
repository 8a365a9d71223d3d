// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/distance_surface.hpp"

#include <cstdint>

namespace palpable::sculpt {

/// An axis-parallel box, metres.
struct Box {
  Vec3 least_m;
  Vec3 most_m;
};

/// A solid that knows its exact distance: what a distance field is sampled from (a mesh, superquadrics, a
/// relief, points). Any thread.
class DistanceSource {
 public:
  DistanceSource() = default;
  DistanceSource(const DistanceSource&) = delete;
  DistanceSource& operator=(const DistanceSource&) = delete;
  virtual ~DistanceSource() = default;

  /// Euclidean distance to the surface at any finite place, negative inside, and its gradient: a unit vector
  /// (on edges and medial sheets that of one side). `hint` is the source's own memory from one call to the
  /// next, a start for places near each other; 0 at first, one for each thread.
  virtual models::FieldSample at(Vec3 place_m, std::uint32_t& hint) const = 0;
  /// Of the solid's surface.
  virtual Box bounds() const = 0;
};

}  // namespace palpable::sculpt
