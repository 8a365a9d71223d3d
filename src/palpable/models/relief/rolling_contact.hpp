// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// A point below the centre of a ball, relative to it, in metres.
struct UnderBall {
  double dx = 0.0;
  double dy = 0.0;
};

/// Second derivatives of a surface or of the ball's underside, in 1/m.
struct Bend {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double determinant() const noexcept { return xx * yy - xy * xy; }
};

/// The slope of the ball's underside at a point of it. Unlike the point's offset from the centre it has no
/// singularity at the rim.
struct BallSlope {
  double x = 0.0;
  double y = 0.0;
};

/// A ball on a relief: the height of its centre, the slope at its contact, and the bend of the surface that
/// the centre follows as long as that contact carries the ball. The slope is also that of this surface.
struct RestingBall {
  double centre_m = 0.0;
  BallSlope slope;
  Bend bend;
};

/// The point at which a ball of this radius has this slope.
UnderBall point_of(BallSlope slope, double radius_m) noexcept;

/// Lets a ball of `radius_m` > 0 with its centre above (x_m, y_m) rest on the surface near `from`: a local
/// maximum of z(p + d) + sqrt(r^2 - |d|^2), by at most `steps` steps of Newton's method. Each height that it
/// tries is a lower bound of the true one, so the greatest of them is returned.
RestingBall rest_ball(const Relief& relief, double radius_m, double x_m, double y_m, UnderBall from,
                      int steps) noexcept;

}  // namespace palpable::models
