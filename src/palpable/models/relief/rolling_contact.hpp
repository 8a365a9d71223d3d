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

/// A ball on a relief: the height of its centre, where it touches, and the surface there.
struct RestingBall {
  double centre_m = 0.0;
  UnderBall contact;
  CurvedSample surface;
};

/// Lets a ball of `radius_m` > 0 with its centre above (x_m, y_m) rest on the surface near `from`: a local
/// maximum of z(p + d) + sqrt(r^2 - |d|^2), by at most `steps` steps of Newton's method. Each height that it
/// tries is a lower bound of the true one, so the greatest of them is returned.
RestingBall rest_ball(const Relief& relief, double radius_m, double x_m, double y_m, UnderBall from,
                      int steps) noexcept;

/// A surface point that a ball touches, with what is needed to predict the height of a ball that touches the
/// surface near it: the slopes there, and the inverse of the second derivatives of ball minus surface.
struct TouchPoint {
  float x_m = 0.0F;
  float y_m = 0.0F;
  float z_m = 0.0F;
  float dzdx = 0.0F;
  float dzdy = 0.0F;
  float inverse_xx_m = 0.0F;
  float inverse_xy_m = 0.0F;
  float inverse_yy_m = 0.0F;
};

/// The touch point of a ball above (x_m, y_m).
TouchPoint touch_point_of(const RestingBall& ball, double radius_m, double x_m, double y_m) noexcept;

/// Height of the centre of a ball above (x_m, y_m) that rests on the point itself, a lower bound; and of one
/// that rests near it, to second order. If the ball reaches the point with its rim or not at all, `likely_m`
/// is for a plane there, and `least_m` no bound but a radius less.
struct PredictedCentre {
  double least_m = 0.0;
  double likely_m = 0.0;
  /// Where that ball touches.
  UnderBall contact;
};
PredictedCentre predict_centre(const TouchPoint& point, double radius_m, double x_m, double y_m) noexcept;

}  // namespace palpable::models
