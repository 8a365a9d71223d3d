// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/field/distance_sample.hpp"
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

  /// One thread's queries of one source: what the source keeps from one query to the next, so that queries
  /// near each other are fast, and what it says about the accuracy of the last one. Default constructed; each
  /// source uses the members that it needs. It is a plain value, so that a builder can have one for each of
  /// its tasks without knowing which kind of source it samples.
  struct Hint {
    /// Search of the nearest triangle: where the next one begins.
    std::uint32_t triangle = 0;
    /// The same for a source's second surface.
    std::uint32_t second_triangle = 0;
    /// Balls that were entered and not left: the triangles near them; the first `entered` are in use.
    std::vector<TriangleShortlist> balls;
    std::size_t entered = 0;

    /// Sign: the last places and their distances (0: none yet). It is the same everywhere within that
    /// distance.
    struct PreviousSample {
      Vec3 place_m;
      double distance_m = 0.0;
    };
    std::array<PreviousSample, 8> last;
    std::size_t oldest = 0;

    /// Accuracy of the last sample as an approximation of the surface, metres and radians: between the
    /// vertices of a scan the surface is an estimate. 0 where it is exact.
    double coarse_m = 0.0, coarse_turn = 0.0;
    /// For a source that blends two distances: their greatest difference in all queries.
    double greatest_difference_m = 0.0;

    /// For a source that adds surfaces to another: one hint for each.
    std::vector<Hint> of_parts;
  };

  /// Announces that the next points are in this ball, which is inside the last one that was entered and not
  /// left. A source may prepare one search for all of them.
  virtual void enter(Vec3 /*centre_m*/, double /*radius_m*/, Hint& /*hint*/) const {}
  virtual void leave(Hint& /*hint*/) const {}

  /// Euclidean distance to the surface at any finite place, negative inside, and its gradient: a unit vector
  /// (on edges and medial sheets that of one side).
  virtual models::DistanceSample at(Vec3 place_m, Hint& hint) const = 0;
  /// The bounding box of the solid's surface.
  virtual Box bounds() const = 0;

 protected:
  DistanceSource() = default;
  DistanceSource(const DistanceSource&) = default;
  DistanceSource(DistanceSource&&) = default;
  DistanceSource& operator=(const DistanceSource&) = default;
  DistanceSource& operator=(DistanceSource&&) = default;
};

}  // namespace palpable::sculpt
