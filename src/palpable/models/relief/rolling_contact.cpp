// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/rolling_contact.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

/// The slope of the ball's underside at a point of it. Unlike the point's offset from the centre it has no
/// singularity at the rim, and on a plane one step of Newton's method finds it.
struct BallSlope {
  double x = 0.0;
  double y = 0.0;
};

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

/// A symmetric matrix of second derivatives.
struct Bend {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double determinant() const noexcept { return xx * yy - xy * xy; }
};

/// The ball's, d(slope)/d(offset).
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

}  // namespace

RestingBall rest_ball(const Relief& relief, double radius_m, double x_m, double y_m, UnderBall from,
                      int steps) noexcept {
  constexpr double kEnough_m = 1e-9;
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
  return {best_m, best.at, s};
}

TouchPoint touch_point_of(const RestingBall& ball, double radius_m, double x_m, double y_m) noexcept {
  const CurvedSample& s = ball.surface;
  const Bend bend = bend_between(s, bend_of_ball(point_with({s.dzdx, s.dzdy}, radius_m)));
  const double per = 1.0 / bend.determinant();
  return {static_cast<float>(x_m + ball.contact.dx),
          static_cast<float>(y_m + ball.contact.dy),
          static_cast<float>(s.z_m),
          static_cast<float>(s.dzdx),
          static_cast<float>(s.dzdy),
          static_cast<float>(per * bend.yy),
          static_cast<float>(-per * bend.xy),
          static_cast<float>(per * bend.xx)};
}

PredictedCentre predict_centre(const TouchPoint& point, double radius_m, double x_m, double y_m) noexcept {
  const double dx = double{point.x_m} - x_m;
  const double dy = double{point.y_m} - y_m;
  const double rest2 = radius_m * radius_m - dx * dx - dy * dy;
  const double sx = double{point.dzdx};
  const double sy = double{point.dzdy};
  const double steep2 = 1.0 + sx * sx + sy * sy;
  // Where the ball is much steeper than the surface, near its rim, a prediction of second order would be
  // wild.
  constexpr double kMuch2 = 4.0;
  if (dx * dx + dy * dy >= kMuch2 * steep2 * rest2) {
    // A ball on the plane that touches the surface there.
    const double steep = std::sqrt(steep2);
    const double plane_m = double{point.z_m} - sx * dx - sy * dy + radius_m * steep;
    return {plane_m - radius_m, plane_m, {radius_m * sx / steep, radius_m * sy / steep}};
  }
  const double depth_m = std::sqrt(rest2);
  const double gx = sx - dx / depth_m;
  const double gy = sy - dy / depth_m;
  const double to_x = double{point.inverse_xx_m} * gx + double{point.inverse_xy_m} * gy;
  const double to_y = double{point.inverse_xy_m} * gx + double{point.inverse_yy_m} * gy;
  const double least_m = double{point.z_m} + depth_m;
  return {least_m, least_m + 0.5 * (gx * to_x + gy * to_y), {dx + to_x, dy + to_y}};
}

}  // namespace palpable::models
