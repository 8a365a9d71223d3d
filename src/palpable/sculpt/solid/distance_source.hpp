// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/triangle_shortlist.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// A solid whose exact distance can be queried: what a distance field is sampled from (a mesh, superquadrics,
/// a relief, points). Any thread.
class DistanceSource {
 public:
  virtual ~DistanceSource() = default;

  /// State that a source keeps from one call to the next, so that queries near each other are fast. Default
  /// constructed at first; one for each thread.
  struct Hint {
    std::uint32_t triangle = 0;
    /// The same of a source's second surface.
    std::uint32_t second_triangle = 0;
    /// The last places and their distances (0: none yet): the sign is the same everywhere within that
    /// distance.
    struct PreviousSample {
      Vec3 place_m;
      double distance_m = 0.0;
    };
    std::array<PreviousSample, 8> last;
    std::size_t oldest = 0;
    /// How far the last sample may differ from the surface that the source approximates, metres and radians:
    /// between the vertices of a scan it is an estimate. 0 where the surface is exact.
    double coarse_m = 0.0, coarse_turn = 0.0;
    /// Of a source that blends two distances: the greatest difference between them at the places queried.
    double greatest_difference_m = 0.0;
    /// The triangles near the balls that were entered; the first `entered` are in use.
    std::vector<TriangleShortlist> balls;
    std::size_t entered = 0;
    /// Of a source that adds surfaces to another: one for each.
    std::vector<Hint> of_parts;
  };

  /// The next places all lie in this ball, which lies in the last one entered and not left: a source may
  /// search it once, for all of them.
  virtual void enter(Vec3 /*centre_m*/, double /*radius_m*/, Hint& /*hint*/) const {}
  virtual void leave(Hint& /*hint*/) const {}

  /// Euclidean distance to the surface at any finite place, negative inside, and its gradient: a unit vector
  /// (on edges and medial sheets that of one side).
  virtual models::FieldSample at(Vec3 place_m, Hint& hint) const = 0;
  /// Of the solid's surface.
  virtual Box bounds() const = 0;

 protected:
  DistanceSource() = default;
  DistanceSource(const DistanceSource&) = default;
  DistanceSource(DistanceSource&&) = default;
  DistanceSource& operator=(const DistanceSource&) = default;
  DistanceSource& operator=(DistanceSource&&) = default;
};

}  // namespace palpable::sculpt
