// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_dilation.hpp"

#include "palpable/models/relief/ball_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <mutex>
#include <vector>

namespace palpable::models {
namespace {

/// The contact point relative to the ball's centre, in pixels.
struct TouchOffset {
  double right = 0.0;
  double up = 0.0;
};

/// The spline's heights at its samples.
Raster<float> heights_at_samples(const Relief& relief) {
  const Raster<float>& values = relief.samples_m();
  Raster<float> heights(values.width(), values.height());
  const double left_m = -0.5 * (values.width() - 1) * relief.pixel_m();
  const double top_m = 0.5 * (values.height() - 1) * relief.pixel_m();
  for (int y = 0; y < heights.height(); ++y)
    for (int x = 0; x < heights.width(); ++x)
      heights(x, y) =
          static_cast<float>(relief.sample(left_m + x * relief.pixel_m(), top_m - y * relief.pixel_m()).z_m);
  return heights;
}

/// A point below the ball, relative to its centre, in metres.
struct UnderBall {
  double dx = 0.0;
  double dy = 0.0;
};

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
  const double determinant = a * c - b * b;
  return {(c * gx - b * gy) / determinant, (a * gy - b * gx) / determinant};
}

/// Height of the centre of a ball at (x_m, y_m) that touches the surface near `from`. Every tried point is a
/// lower bound, so the maximum is used.
double centre_height(const Relief& relief, double radius_m, double x_m, double y_m, TouchOffset from) {
  constexpr int kSteps = 5;
  constexpr double kEnough_m = 1e-8;
  // Near its rim the ball is too steep for Newton's method.
  constexpr double kStart = 0.9;
  constexpr double kRim = 0.9999;
  const double pixel_m = relief.pixel_m();
  UnderBall best = held({from.right * pixel_m, from.up * pixel_m}, radius_m, kStart);
  CurvedSample s = relief.curved_sample(x_m + best.dx, y_m + best.dy);
  double best_m = s.z_m + std::sqrt(radius_m * radius_m - best.dx * best.dx - best.dy * best.dy);
  // The contact point of a plane with this slope.
  const double plane_m = radius_m / std::sqrt(1.0 + s.dzdx * s.dzdx + s.dzdy * s.dzdy);
  UnderBall step{plane_m * s.dzdx - best.dx, plane_m * s.dzdy - best.dy};
  for (int k = 0; k < kSteps; ++k) {
    const double length_m = std::hypot(step.dx, step.dy);
    if (length_m < kEnough_m) break;
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
  return best_m;
}

/// Control values whose spline approximates `heights`. The spline lowers curved surfaces by a sixth of the
/// second differences; these are at most `most_bent` on a surface over which a ball rolled.
Raster<float> control_values_for(const Raster<float>& heights, double most_bent) {
  const auto most = static_cast<float>(most_bent);
  Raster<float> values = heights;
  const int w = heights.width();
  const int h = heights.height();
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const float z = heights(x, y);
      const float across = heights(std::max(x - 1, 0), y) + heights(std::min(x + 1, w - 1), y) - 2.0F * z;
      const float down = heights(x, std::max(y - 1, 0)) + heights(x, std::min(y + 1, h - 1)) - 2.0F * z;
      values(x, y) = z - (std::clamp(across, -most, most) + std::clamp(down, -most, most)) / 6.0F;
    }
  return values;
}

/// Counts finished rows on all threads, and reports every hundredth.
class RowsDone {
 public:
  RowsDone(const Work& work, int rows) : work_(work), rows_(rows) {}
  void add() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (100 * done_ / rows_ != 100 * (done_ - 1) / rows_)
      work_.report(static_cast<double>(done_) / static_cast<double>(rows_),
                   "rolling the ball over the relief");
  }

 private:
  const Work& work_;
  std::int64_t rows_;
  std::int64_t done_ = 0;
  std::mutex mutex_;
};

}  // namespace

Raster<float> dilate_by_ball(const Relief& relief, double radius_m, const Work& work) {
  PALPABLE_CHECK(radius_m > 0.0);
  const double pixel_m = relief.pixel_m();
  // Heights in pixels, so that the search over samples uses one unit.
  Raster<float> heights = heights_at_samples(relief);
  for (float& z : heights.values()) z = static_cast<float>(z / pixel_m);
  const BallContacts contacts(heights, radius_m / pixel_m);
  const int w = heights.width();
  const int h = heights.height();
  Raster<float> centre(w, h);
  RowsDone done(work, h);
  parallel_for(work, h, 8, [&](int begin, int end) {
    std::vector<ContactOffset> found(static_cast<std::size_t>(w));
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      contacts.find_row(y, found);
      for (int x = 0; x < w; ++x) {
        const ContactOffset contact = found[static_cast<std::size_t>(x)];
        const TouchOffset offset{1.0 * contact.right, -1.0 * contact.down};
        centre(x, y) = static_cast<float>(centre_height(relief, radius_m, (x - 0.5 * (w - 1)) * pixel_m,
                                                        (0.5 * (h - 1) - y) * pixel_m, offset));
      }
      done.add();
    }
  });
  const double steep2 = 1.0 + relief.steepest_slope() * relief.steepest_slope();
  return control_values_for(centre, pixel_m * pixel_m / radius_m * steep2 * std::sqrt(steep2));
}

Raster<float> erode_by_ball(const Relief& relief, double radius_m, const Work& work) {
  Raster<float> hollow = relief.samples_m();
  for (float& z : hollow.values()) z = -z;
  auto turned = Relief::from_samples(std::move(hollow), relief.pixel_m());
  PALPABLE_CHECK(turned.has_value());
  Raster<float> deep = dilate_by_ball(*turned, radius_m, work);
  for (float& z : deep.values()) z = -z;
  return deep;
}

}  // namespace palpable::models
