// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {

/// A horizontal step, in metres.
struct GroundStep {
  double dx = 0.0;
  double dy = 0.0;
};

/// Newton's step towards the surface point nearest to a given point. `s`: the height field's derivatives at
/// the current surface point; `d`: the vector from there to the given point. The step is scaled by `part` in
/// (0, 1] and at most `longest_m` long. If the Hessian is not positive definite (a point far below a ridge),
/// it is a descent step of that length. Tick path.
inline GroundStep step_towards_nearest(Vec3 d, const CurvedSample& s, double part,
                                       double longest_m) noexcept {
  // Half the squared distance as a function of the horizontal position: its negative gradient and its second
  // derivatives.
  const double down_x = d.x + d.z * s.dzdx;
  const double down_y = d.y + d.z * s.dzdy;
  const double level_xx = 1.0 + s.dzdx * s.dzdx;
  const double level_xy = s.dzdx * s.dzdy;
  const double level_yy = 1.0 + s.dzdy * s.dzdy;
  const double bent_xx = level_xx - d.z * s.dzdxx_per_m;
  const double bent_xy = level_xy - d.z * s.dzdxy_per_m;
  const double bent_yy = level_yy - d.z * s.dzdyy_per_m;
  const double bent_determinant = bent_xx * bent_yy - bent_xy * bent_xy;
  constexpr double kLeast = 0.05;
  const double level_determinant = level_xx * level_yy - level_xy * level_xy;
  const bool bends_rightly = bent_xx + bent_yy > 0.0 && bent_determinant > kLeast * level_determinant;
  const double xx = bends_rightly ? bent_xx : level_xx;
  const double xy = bends_rightly ? bent_xy : level_xy;
  const double yy = bends_rightly ? bent_yy : level_yy;
  const double determinant = bends_rightly ? bent_determinant : kLeast * level_determinant;
  const double x = yy * down_x - xy * down_y;
  const double y = xx * down_y - xy * down_x;
  // The division does not wait for `part`, and the length is computed only for a long step: this is on the
  // tick's critical path.
  double along = part * (1.0 / determinant);
  const double whole2 = x * x + y * y;
  if (along * along * whole2 > longest_m * longest_m) along = longest_m / std::sqrt(whole2);
  return {along * x, along * y};
}

}  // namespace palpable::models
