// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/study/world/room.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::study {

/// A solid with the sine and cosine of its turn.
struct TurnedSolid {
  explicit TurnedSolid(const Solid& s)
      : solid(s), cos_turn(std::cos(s.turn_rad)), sin_turn(std::sin(s.turn_rad)) {}

  /// A direction in the solid's own axes, and back.
  Vec3 into(Vec3 d) const { return {cos_turn * d.x + sin_turn * d.y, cos_turn * d.y - sin_turn * d.x, d.z}; }
  Vec3 out(Vec3 d) const { return {cos_turn * d.x - sin_turn * d.y, cos_turn * d.y + sin_turn * d.x, d.z}; }

  Solid solid;
  double cos_turn, sin_turn;
};

/// Where the ray origin + t * direction (both in the solid's own axes, the origin relative to its centre)
/// enters the solid: t > 0, or infinity. `normal` and the position on the surface are set on a hit.
double enter_box(Vec3 half_m, Vec3 origin, Vec3 direction, Hit& hit);
double enter_cylinder(Vec3 half_m, Vec3 origin, Vec3 direction, Hit& hit);

inline double enter(const Solid& solid, Vec3 origin, Vec3 direction, Hit& hit) {
  return solid.shape == Solid::Shape::box ? enter_box(solid.half_m, origin, direction, hit)
                                          : enter_cylinder(solid.half_m, origin, direction, hit);
}

/// Where a ray leaves the room.
Hit leave_room(Vec3 size_m, Vec3 origin, Vec3 direction);

/// Signed distance from a solid, negative inside; `p` in world axes.
double distance_m(const TurnedSolid& turned, Vec3 p);
/// Horizontal distance of a vertical line from a solid, 0 inside.
double horizontal_distance_m(const TurnedSolid& turned, double x_m, double y_m);

}  // namespace palpable::study
