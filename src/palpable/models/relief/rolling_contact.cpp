// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/rolling_contact.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

/// With slopes, one step of Newton's method finds the contact on a plane.
BallSlope slope_at(UnderBall at, double radius_m, double steepest) noexcept {
  const double length2 = at.dx * at.dx + at.dy * at.dy;
  const double rest2 = radius_m * radius_m - length2;
  // A surface that is nowhere steeper touches no steeper part of the ball.
  if (!(rest2 * steepest * steepest > length2)) {
    const double share = length2 > 0.0 ? steepest / std::sqrt(length2) : 0.0;
    return {share * at.dx, share * at.dy};
  }
  const double per_m = 1.0 / std::sqrt(rest2);
  return {per_m * at.dx, per_m * at.dy};
}

/// A point of the ball: its slope, its offset, and its depth below the centre.
struct BallPoint {
  BallSlope slope;
  UnderBall at;
  double depth_m = 0.0;
};

BallPoint point_with(BallSlope slope, double radius_m) noexcept {
  const double depth_m = radius_m / std::sqrt(1.0 + slope.x * slope.x + slope.y * slope.y);
  return {slope, {depth_m * slope.x, depth_m * slope.y}, depth_m};
}

/// d(slope)/d(offset) of the ball.
Bend bend_of_ball(const BallPoint& on) noexcept {
  const double per_m = 1.0 / on.depth_m;
  return {per_m * (1.0 + on.slope.x * on.slope.x), per_m * on.slope.x * on.slope.y,
          per_m * (1.0 + on.slope.y * on.slope.y)};
}

/// The ball's minus the surface's where their sum is concave enough, and else a small part of the ball's.
Bend bend_between(const CurvedSample& s, const Bend& ball) noexcept {
  constexpr double kLeast = 0.05;
  const Bend bend{ball.xx - s.dzdxx_per_m, ball.xy - s.dzdxy_per_m, ball.yy - s.dzdyy_per_m};
  if (bend.xx > 0.0 && bend.determinant() > kLeast * ball.determinant()) return bend;
  constexpr double kPart = 0.25;
  return {kPart * ball.xx, kPart * ball.xy, kPart * ball.yy};
}

/// Newton's step of the slope towards the maximum of z(p + d) + sqrt(r^2 - |d|^2), and what it gains there.
struct Step {
  BallSlope slope;
  double gain_m = 0.0;
};

Step newton_step(const CurvedSample& s, const BallPoint& on) noexcept {
  const double gx = s.dzdx - on.slope.x;
  const double gy = s.dzdy - on.slope.y;
  const Bend ball = bend_of_ball(on);
  const Bend bend = bend_between(s, ball);
  const double per = 1.0 / bend.determinant();
  const double dx = per * (bend.yy * gx - bend.xy * gy);
  const double dy = per * (bend.xx * gy - bend.xy * gx);
  return {{ball.xx * dx + ball.xy * dy, ball.xy * dx + ball.yy * dy}, 0.5 * (gx * dx + gy * dy)};
}

/// The bend of the centre's height, B M^-1 B - B: B of the ball, M of the ball minus the surface.
Bend bend_of_centre(const CurvedSample& s, const BallPoint& on) noexcept {
  const Bend b = bend_of_ball(on);
  const Bend m = bend_between(s, b);
  const double per = 1.0 / m.determinant();
  // M^-1 B, row by row.
  const double xx = per * (m.yy * b.xx - m.xy * b.xy);
  const double xy = per * (m.yy * b.xy - m.xy * b.yy);
  const double yx = per * (m.xx * b.xy - m.xy * b.xx);
  const double yy = per * (m.xx * b.yy - m.xy * b.xy);
  return {b.xx * xx + b.xy * yx - b.xx, b.xx * xy + b.xy * yy - b.xy, b.xy * xy + b.yy * yy - b.yy};
}

}  // namespace

UnderBall point_of(BallSlope slope, double radius_m) noexcept { return point_with(slope, radius_m).at; }

RestingBall rest_ball(const Relief& relief, double radius_m, double x_m, double y_m, UnderBall from,
                      int steps) noexcept {
  constexpr double kEnough_m = 1e-7;
  const double pixel_m = relief.pixel_m();
  BallPoint best = point_with(slope_at(from, radius_m, relief.steepest_slope()), radius_m);
  CurvedSample s = relief.curved_sample(x_m + best.at.dx, y_m + best.at.dy);
  double best_m = s.z_m + best.depth_m;
  Step step = newton_step(s, best);
  for (int k = 0; k < steps && step.gain_m > kEnough_m; ++k) {
    BallPoint next = point_with({best.slope.x + step.slope.x, best.slope.y + step.slope.y}, radius_m);
    const double dx = next.at.dx - best.at.dx;
    const double dy = next.at.dy - best.at.dy;
    if (dx * dx + dy * dy > pixel_m * pixel_m) {
      const double shorter = pixel_m / std::sqrt(dx * dx + dy * dy);
      step.slope = {shorter * step.slope.x, shorter * step.slope.y};
      next = point_with({best.slope.x + step.slope.x, best.slope.y + step.slope.y}, radius_m);
    }
    const CurvedSample there = relief.curved_sample(x_m + next.at.dx, y_m + next.at.dy);
    if (there.z_m + next.depth_m <= best_m) {
      step = {{0.25 * step.slope.x, 0.25 * step.slope.y}, 0.25 * step.gain_m};
      continue;
    }
    best_m = there.z_m + next.depth_m;
    best = next;
    s = there;
    step = newton_step(s, best);
  }
  return {best_m, best.slope, bend_of_centre(s, best)};
}

}  // namespace palpable::models
