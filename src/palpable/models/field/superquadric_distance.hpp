// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/superquadric.hpp"
#include "palpable/models/relief/relief_distance.hpp"

#include <array>
#include <limits>
#include <vector>

namespace palpable::models {

/// Euclidean distance to one superquadric, deformation and pose included. Immutable; any thread; a query
/// never allocates and takes some microseconds: for building fields, not for the tick.
class SuperquadricDistance {
 public:
  /// Errors: check_superquadric()'s.
  static Result<SuperquadricDistance> from(const Superquadric& shape);

  /// The nearest point of the surface by Newton's method, safe from every start. Of an undeformed shape (a
  /// convex body) it is the global one: outside there is only one, inside each face's is tried. A tapered or
  /// bent shape's surface is sampled coarsely first. `p` is finite.
  ClosestPoint closest_point(Point<SceneFrame> p) const noexcept;
  double distance_m(Point<SceneFrame> p) const noexcept { return closest_point(p).distance_m; }
  /// Never more than distance_m(), and reckoned at once.
  double least_distance_m(Point<SceneFrame> p) const noexcept;

  const Superquadric& shape() const noexcept { return shape_; }

  /// In the shape's own frame.
  struct Local {
    Vec3 place, normal;
    double distance_m = std::numeric_limits<double>::infinity();
  };

 private:
  explicit SuperquadricDistance(const Superquadric& shape);
  Local nearest_deformed(Vec3 x) const noexcept;

  /// Points of the undeformed surface, and where the deformation takes them; only of a deformed shape.
  struct Seed {
    Vec3 straight;
    Vec3 place;
  };
  Superquadric shape_;
  Transform<ShapeFrame, SceneFrame> shape_from_scene_;
  /// Six parts of equal length, one a side of the box around the shape.
  std::vector<Seed> seeds_;
  /// How far at most a place of each side is from the side's nearest seed, as far as finer samples tell.
  std::array<double, 6> gaps_m_{};
  /// No place of the surface is farther from the centre.
  double reach_m_ = 0.0;
};

/// The union of several: the nearest surface of them all that is not inside another one; inside, the deepest
/// in any one, which is exact where they do not overlap and a bound where they do. `shapes` is not empty.
ClosestPoint closest_point(const std::vector<SuperquadricDistance>& shapes, Point<SceneFrame> p) noexcept;

}  // namespace palpable::models
