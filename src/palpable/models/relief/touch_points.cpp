// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/touch_points.hpp"

#include "palpable/models/relief/ball_contacts.hpp"
#include "palpable/models/relief/rows_done.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

/// Steps of Newton's method for one contact: most need three, nearly flat ones more.
constexpr int kContactSteps = 12;
/// Samples of the search per pixel: a pixel's own would miss contacts on steep and rough ground, and a ball
/// of a few pixels needs more.
int samples_per_pixel(double radius_px) { return radius_px >= 2.0 ? 2 : radius_px >= 0.75 ? 4 : 8; }
/// Of the work of making a ball's surface.
constexpr WorkPart kSearchPart{0.0, 0.3};
/// How much lower than the best one a sample may be that leads to the contact, in sample distances.
constexpr float kSlack = 1.0F;
/// Two contacts nearer than this share of a pixel are the same.
constexpr double kSame = 0.05;

/// The relief's heights at several samples per pixel, in their own distance.
Raster<float> finer_heights(const Relief& relief, int per_pixel, const Work& work) {
  const int w = per_pixel * (relief.samples_m().width() - 1) + 1;
  const int h = per_pixel * (relief.samples_m().height() - 1) + 1;
  const double step_m = relief.pixel_m() / per_pixel;
  Raster<float> heights(w, h);
  parallel_for(work, h, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < w; ++x)
        heights(x, y) = static_cast<float>(
            relief.sample((x - 0.5 * (w - 1)) * step_m, (0.5 * (h - 1) - y) * step_m).z_m / step_m);
  });
  return heights;
}

}  // namespace

TouchPoints::TouchPoints(const Relief& relief, double radius_m, const Work& work)
    : relief_(relief),
      radius_m_(radius_m),
      centre_m_(relief.samples_m().width(), relief.samples_m().height()),
      rows_(static_cast<std::size_t>(centre_m_.height())),
      begin_(centre_m_.width() + 1, centre_m_.height()) {
  const int per_pixel = samples_per_pixel(radius_m / relief.pixel_m());
  const double step_m = relief.pixel_m() / per_pixel;
  const Raster<float> heights = finer_heights(relief, per_pixel, work);
  const BallContacts contacts(heights, radius_m / step_m);
  RowsDone done(work, centre_m_.height(), kSearchPart);
  parallel_for(work, centre_m_.height(), 8, [&](int begin, int end) {
    std::vector<ContactOffset> found;
    std::vector<RestingBall> balls;
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      std::vector<TouchPoint>& row = rows_[static_cast<std::size_t>(y)];
      for (int x = 0; x < centre_m_.width(); ++x) {
        contacts.find_all(per_pixel * x, per_pixel * y, kSlack, found);
        balls.clear();
        for (const ContactOffset at : found)
          balls.push_back(rest_ball(relief, radius_m, x_m(x), y_m(y), {at.right * step_m, -at.down * step_m},
                                    kContactSteps));
        std::sort(balls.begin(), balls.end(),
                  [](const RestingBall& a, const RestingBall& b) { return a.centre_m > b.centre_m; });
        begin_(x, y) = static_cast<std::uint32_t>(row.size());
        centre_m_(x, y) = static_cast<float>(balls.front().centre_m);
        for (std::size_t k = 0; k < balls.size(); ++k) {
          const bool is_new = std::none_of(
              balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(k), [&](const RestingBall& other) {
                return std::hypot(other.contact.dx - balls[k].contact.dx,
                                  other.contact.dy - balls[k].contact.dy) < kSame * relief.pixel_m();
              });
          if (is_new) row.push_back(touch_point_of(balls[k], radius_m, x_m(x), y_m(y)));
        }
      }
      begin_(centre_m_.width(), y) = static_cast<std::uint32_t>(row.size());
      done.add();
    }
  });
}

std::span<const TouchPoint> TouchPoints::of_sample(int x, int y) const {
  const std::vector<TouchPoint>& row = rows_[static_cast<std::size_t>(y)];
  return {row.data() + begin_(x, y), row.data() + begin_(x + 1, y)};
}

void TouchPoints::of_cell(int i, int j, std::vector<TouchPoint>& points) const {
  points.clear();
  const double middle_x_m = 0.5 * (x_m(i) + x_m(i + 1));
  const double middle_y_m = 0.5 * (y_m(j) + y_m(j + 1));
  const double same_m = kSame * relief_.pixel_m();
  for (int y = j; y <= j + 1; ++y)
    for (int x = i; x <= i + 1; ++x)
      for (const TouchPoint& point : of_sample(x, y)) {
        // Contacts that lead to the same one from two corners of the cell do so from all of it.
        const UnderBall at = predict_centre(point, radius_m_, middle_x_m, middle_y_m).contact;
        const bool is_known = std::any_of(points.begin(), points.end(), [&](const TouchPoint& other) {
          const UnderBall to = predict_centre(other, radius_m_, middle_x_m, middle_y_m).contact;
          return std::abs(at.dx - to.dx) + std::abs(at.dy - to.dy) < same_m;
        });
        if (!is_known) points.push_back(point);
      }
}

double TouchPoints::centre_m(std::span<const TouchPoint> points, double x_m, double y_m) const {
  // A prediction of second order errs by less than this, or this share of what it adds.
  constexpr double kSure_m = 2e-7;
  constexpr double kShare = 1.0;
  constexpr double kHighest_m = 1e9;
  constexpr double kSmall = 2.0;
  const auto rest_near = [&](UnderBall from) {
    return rest_ball(relief_, radius_m_, x_m, y_m, from, kContactSteps);
  };
  PredictedCentre first{0.0, -kHighest_m, {}};
  for (const TouchPoint& point : points) {
    const PredictedCentre at = predict_centre(point, radius_m_, x_m, y_m);
    if (at.likely_m > first.likely_m) first = at;
  }
  RestingBall ball = rest_near(first.contact);
  const double same_m = kSame * relief_.pixel_m();
  for (const TouchPoint& point : points) {
    const PredictedCentre at = predict_centre(point, radius_m_, x_m, y_m);
    if (at.likely_m + kShare * (at.likely_m - at.least_m) <= ball.centre_m + kSure_m) continue;
    if (std::abs(at.contact.dx - ball.contact.dx) + std::abs(at.contact.dy - ball.contact.dy) < same_m)
      continue;
    const RestingBall other = rest_near(at.contact);
    if (other.centre_m > ball.centre_m) ball = other;
  }
  // The contacts of the corners may be out of the reach of a ball that is smaller than a cell.
  if (radius_m_ < kSmall * relief_.pixel_m()) return std::max(ball.centre_m, rest_near({}).centre_m);
  return ball.centre_m;
}

}  // namespace palpable::models
