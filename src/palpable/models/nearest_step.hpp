// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/relief.hpp"

#include <cmath>

namespace palpable::models {

/// A step over the ground, in metres.
struct GroundStep {
  double dx = 0.0;
  double dy = 0.0;
};

/// From a place of a height field with the derivatives `s`, Newton's step towards the place nearest to a
/// point that stands at `d` from it, times `part` (0 ... 1] and at most `longest_m` long. Where the distance
/// bends the wrong way (a point far below a ridge), `longest_m` along its descent. Tick path.
inline GroundStep step_towards_nearest(Vec3 d, const CurvedSample& s, double part,
                                       double longest_m) noexcept {
  // Half the squared distance as a function of the ground's place: minus its gradient, and its second
  // derivatives.
  const double down_x = d.x + d.z * s.dzdx;
  const double down_y = d.y + d.z * s.dzdy;
  const double level_xx = 1.0 + s.dzdx * s.dzdx;
  const double level_xy = s.dzdx * s.dzdy;
  const double level_yy = 1.0 + s.dzdy * s.dzdy;
  double xx = level_xx - d.z * s.dzdxx_per_m;
  double xy = level_xy - d.z * s.dzdxy_per_m;
  double yy = level_yy - d.z * s.dzdyy_per_m;
  double determinant = xx * yy - xy * xy;
  constexpr double kLeast = 0.05;
  const double level_determinant = level_xx * level_yy - level_xy * level_xy;
  if (!(xx + yy > 0.0 && determinant > kLeast * level_determinant)) {
    xx = level_xx;
    xy = level_xy;
    yy = level_yy;
    determinant = level_determinant;
    part /= kLeast;
  }
  GroundStep step{(yy * down_x - xy * down_y) / determinant * part,
                  (xx * down_y - xy * down_x) / determinant * part};
  const double length2 = step.dx * step.dx + step.dy * step.dy;
  if (length2 > longest_m * longest_m) {
    const double shrink = longest_m / std::sqrt(length2);
    step.dx *= shrink;
    step.dy *= shrink;
  }
  return step;
}

}  // namespace palpable::models
