// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

namespace palpable::models {

/// A point below a ball, relative to its centre, in metres.
struct UnderBall {
  double dx = 0.0;
  double dy = 0.0;
};

/// A ball that touches a relief: the height of its centre, and its contact point. Not `found` if the method
/// ended before it: then the ball is somewhat too low.
struct BallContact {
  double height_m = 0.0;
  UnderBall at;
  bool found = false;
};

/// The ball with its centre above (x_m, y_m) that touches the surface near `from`: a local maximum of z(p +
/// d) + sqrt(r^2 - |d|^2), by Newton's method in at most nine evaluations. Every tried point is a lower
/// bound, so the greatest is returned. Any finite values; radius_m > 0.
BallContact touch_by_ball(const Relief& relief, double radius_m, double x_m, double y_m,
                          UnderBall from) noexcept;

}  // namespace palpable::models
