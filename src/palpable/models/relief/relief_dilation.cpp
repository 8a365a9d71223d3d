// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_dilation.hpp"

#include "palpable/models/relief/ball_contacts.hpp"
#include "palpable/models/relief/rolling_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

namespace palpable::models {
namespace {

/// Steps of Newton's method for one contact.
constexpr int kSteps = 6;

/// A ball above a sample, as RestingBall: the height in metres, the bend in 1/m.
struct BallAbove {
  float centre_m = 0.0F;
  float slope_x = 0.0F;
  float slope_y = 0.0F;
  float bend_xx = 0.0F;
  float bend_xy = 0.0F;
  float bend_yy = 0.0F;
};

BallAbove ball_above(const RestingBall& ball) {
  const auto f = [](double v) { return static_cast<float>(v); };
  return {f(ball.centre_m), f(ball.slope.x), f(ball.slope.y),
          f(ball.bend.xx),  f(ball.bend.xy), f(ball.bend.yy)};
}

/// The spline's heights at its samples: 1, 4 and 1 sixths of the control values around, along both axes.
Raster<float> heights_at_samples(const Relief& relief) {
  const Raster<float>& values = relief.samples_m();
  const int w = values.width(), h = values.height();
  const auto mean = [](float before, float at, float after) { return (before + 4.0F * at + after) / 6.0F; };
  Raster<float> heights(w, h);
  std::vector<float> down(static_cast<std::size_t>(w));
  for (int y = 0; y < h; ++y) {
    const int above = std::max(y - 1, 0), below = std::min(y + 1, h - 1);
    for (int x = 0; x < w; ++x)
      down[static_cast<std::size_t>(x)] = mean(values(x, above), values(x, y), values(x, below));
    for (int x = 0; x < w; ++x)
      heights(x, y) =
          mean(down[static_cast<std::size_t>(std::max(x - 1, 0))], down[static_cast<std::size_t>(x)],
               down[static_cast<std::size_t>(std::min(x + 1, w - 1))]);
  }
  return heights;
}

/// Lets the balls of a row rest on their neighbours' contacts too, where these promise more: of two contacts
/// that are nearly as high the best sample may lead to the lower one.
class NeighbourContacts {
 public:
  NeighbourContacts(const Relief& relief, double radius_m, const Raster<BallAbove>& balls)
      : relief_(relief), radius_m_(radius_m), balls_(balls) {}

  void raise_row(int y, Raster<float>& centre_m) const {
    for (int x = 0; x < balls_.width(); ++x) centre_m(x, y) = raised(x, y);
  }

 private:
  /// What a contact must promise above the height that is known to be tried, how many are tried, and by how
  /// many steps: they begin where the neighbour's ended. With 2 um, three, six and eight neighbours this
  /// takes seven times as long on a real depth frame, and 1 of 1500 balls rises by more than 5 um.
  static constexpr float kGain_m = 8e-6F;
  static constexpr int kTries = 2;
  static constexpr int kSteps = 3;

  struct Neighbour {
    int right;
    int down;
  };
  static constexpr std::array<Neighbour, 4> kNeighbours{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  static constexpr float kNone_m = -1e9F;

  float raised(int x, int y) const {
    float best_m = balls_(x, y).centre_m;
    std::array<float, kNeighbours.size()> promised;
    for (std::size_t k = 0; k < promised.size(); ++k) promised[k] = promised_m(x, y, kNeighbours[k]);
    for (int tries = 0; tries < kTries; ++tries) {
      const auto most = std::max_element(promised.begin(), promised.end());
      if (*most <= best_m + kGain_m) break;
      const auto k = static_cast<std::size_t>(most - promised.begin());
      best_m = std::max(best_m, height_at(x, y, kNeighbours[k]));
      *most = kNone_m;
    }
    return best_m;
  }

  /// The height above (x, y) of a ball that rests near the neighbour's contact.
  float height_at(int x, int y, Neighbour from) const {
    const BallAbove& there = balls_(x + from.right, y + from.down);
    const double pixel_m = relief_.pixel_m();
    const UnderBall at = point_of({double{there.slope_x}, double{there.slope_y}}, radius_m_);
    const RestingBall ball = rest_ball(relief_, radius_m_, (x - 0.5 * (balls_.width() - 1)) * pixel_m,
                                       (0.5 * (balls_.height() - 1) - y) * pixel_m,
                                       {at.dx + from.right * pixel_m, at.dy - from.down * pixel_m}, kSteps);
    return static_cast<float>(ball.centre_m);
  }

  /// The same to second order, from what is known there; kNone_m outside.
  float promised_m(int x, int y, Neighbour from) const {
    if (!balls_.contains(x + from.right, y + from.down)) return kNone_m;
    const BallAbove& there = balls_(x + from.right, y + from.down);
    const auto right_m = static_cast<float>(from.right * relief_.pixel_m());
    const auto up_m = static_cast<float>(-from.down * relief_.pixel_m());
    return there.centre_m - (there.slope_x * right_m + there.slope_y * up_m) +
           0.5F * (there.bend_xx * right_m * right_m + there.bend_yy * up_m * up_m) +
           there.bend_xy * right_m * up_m;
  }

  const Relief& relief_;
  double radius_m_;
  const Raster<BallAbove>& balls_;
};

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
  Raster<BallAbove> balls(w, h);
  RowsDone done(work, h);
  parallel_for(work, h, 8, [&](int begin, int end) {
    std::vector<ContactOffset> found(static_cast<std::size_t>(w));
    for (int y = begin; y < end && !work.cancelled(); ++y) {
      contacts.find_row(y, found);
      for (int x = 0; x < w; ++x) {
        const ContactOffset contact = found[static_cast<std::size_t>(x)];
        balls(x, y) = ball_above(rest_ball(relief, radius_m, (x - 0.5 * (w - 1)) * pixel_m,
                                           (0.5 * (h - 1) - y) * pixel_m,
                                           {contact.right * pixel_m, -contact.down * pixel_m}, kSteps));
      }
      done.add();
    }
  });
  Raster<float> centre(w, h);
  const NeighbourContacts neighbours(relief, radius_m, balls);
  parallel_for(work, h, 8, [&](int begin, int end) {
    for (int y = begin; y < end && !work.cancelled(); ++y) neighbours.raise_row(y, centre);
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
