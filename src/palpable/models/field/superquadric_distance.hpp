// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/superquadric.hpp"
#include "palpable/models/relief/relief_distance.hpp"

#include <array>
#include <limits>
#include <vector>

namespace palpable::models {

/// Euclidean distance to one superquadric with deformation and pose. Immutable; any thread. A query never
/// allocates but takes some microseconds: for building fields, not for the tick.
class SuperquadricDistance {
 public:
  /// Errors: check_superquadric()'s.
  static Result<SuperquadricDistance> from(const Superquadric& shape);

  /// The nearest point of the surface by a damped Newton method. For an undeformed shape (a convex body) it
  /// is the global minimum: outside it is unique, inside each face is tried. A tapered or bent surface is
  /// first sampled coarsely. `p` must be finite.
  ClosestPoint closest_point(Point<SceneFrame> p) const noexcept;
  double distance_m(Point<SceneFrame> p) const noexcept { return closest_point(p).distance_m; }
  /// A cheap lower bound of distance_m().
  double least_distance_m(Point<SceneFrame> p) const noexcept;

  const Superquadric& shape() const noexcept { return shape_; }

  /// A nearest point in the shape's own frame.
  struct Local {
    Vec3 place, normal;
    double distance_m = std::numeric_limits<double>::infinity();
  };

 private:
  explicit SuperquadricDistance(const Superquadric& shape);
  Local nearest_deformed(Vec3 x) const noexcept;

  /// Points of the undeformed surface and their deformed positions; only for a deformed shape.
  struct Seed {
    Vec3 straight;
    Vec3 place;
  };
  Superquadric shape_;
  Transform<ShapeFrame, SceneFrame> shape_from_scene_;
  /// Six parts of equal length, one per side of the shape's bounding box.
  std::vector<Seed> seeds_;
  /// Greatest distance of a point of each side from the nearest seed, estimated by finer samples.
  std::array<double, 6> gaps_m_{};
  /// Greatest distance of the surface from the centre.
  double reach_m_ = 0.0;
};

/// The union of several shapes. Outside: the nearest surface point that is not inside another shape. Inside:
/// the greatest depth in any one shape, which is exact without overlap and otherwise a bound. `shapes` is not
/// empty.
ClosestPoint closest_point(const std::vector<SuperquadricDistance>& shapes, Point<SceneFrame> p) noexcept;

}  // namespace palpable::models
