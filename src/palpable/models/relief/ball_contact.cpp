// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/ball_contact.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

/// Limits an offset to `share` of the radius.
UnderBall held(UnderBall at, double radius_m, double share) {
  const double length_m = std::hypot(at.dx, at.dy);
  if (length_m <= share * radius_m) return at;
  const double shrunk = share * radius_m / length_m;
  return {shrunk * at.dx, shrunk * at.dy};
}

/// Newton's step towards the maximum of z(p + d) + sqrt(r^2 - |d|^2), from d = `at`. The surface's curvature
/// is included where the sum stays concave.
UnderBall newton_step(const CurvedSample& s, UnderBall at, double radius_m) {
  const double per = 1.0 / std::sqrt(radius_m * radius_m - at.dx * at.dx - at.dy * at.dy);
  const double per3 = per * per * per;
  const double ball_xx = per + at.dx * at.dx * per3;
  const double ball_xy = at.dx * at.dy * per3;
  const double ball_yy = per + at.dy * at.dy * per3;
  const double xx = ball_xx - s.dzdxx_per_m;
  const double xy = ball_xy - s.dzdxy_per_m;
  const double yy = ball_yy - s.dzdyy_per_m;
  constexpr double kLeast = 0.05;
  const double ball = ball_xx * ball_yy - ball_xy * ball_xy;
  const bool is_concave = xx > 0.0 && xx * yy - xy * xy > kLeast * ball;
  const double a = is_concave ? xx : ball_xx;
  const double b = is_concave ? xy : ball_xy;
  const double c = is_concave ? yy : ball_yy;
  const double gx = s.dzdx - at.dx * per;
  const double gy = s.dzdy - at.dy * per;
  // Elsewhere the way is longer than the ball's own curvature says, as around the tip of a conical pit.
  const double determinant = is_concave ? a * c - b * b : kLeast * ball;
  return {(c * gx - b * gy) / determinant, (a * gy - b * gx) / determinant};
}

}  // namespace

BallContact touch_by_ball(const Relief& relief, double radius_m, double x_m, double y_m,
                          UnderBall from) noexcept {
  constexpr int kSteps = 8;
  constexpr double kEnough_m = 1e-8;
  // Near its rim the ball is too steep for Newton's method.
  constexpr double kStart = 0.9;
  constexpr double kRim = 0.9999;
  const double pixel_m = relief.pixel_m();
  UnderBall best = held(from, radius_m, kStart);
  CurvedSample s = relief.curved_sample(x_m + best.dx, y_m + best.dy);
  double best_m = s.z_m + std::sqrt(radius_m * radius_m - best.dx * best.dx - best.dy * best.dy);
  // The contact point of a plane with this slope.
  const double plane_m = radius_m / std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
  UnderBall step{plane_m * s.dzdx - best.dx, plane_m * s.dzdy - best.dy};
  for (int k = 0; k < kSteps; ++k) {
    const double length_m = std::hypot(step.dx, step.dy);
    if (length_m < kEnough_m) return {best_m, best, true};
    const double shorter = std::min(1.0, pixel_m / length_m);
    const UnderBall next = held({best.dx + shorter * step.dx, best.dy + shorter * step.dy}, radius_m, kRim);
    const CurvedSample there = relief.curved_sample(x_m + next.dx, y_m + next.dy);
    const double over_m = std::sqrt(radius_m * radius_m - next.dx * next.dx - next.dy * next.dy);
    if (there.z_m + over_m <= best_m) {
      step = {0.25 * shorter * step.dx, 0.25 * shorter * step.dy};
      continue;
    }
    best_m = there.z_m + over_m;
    best = next;
    s = there;
    step = newton_step(s, best, radius_m);
  }
  return {best_m, best, false};
}

}  // namespace palpable::models
