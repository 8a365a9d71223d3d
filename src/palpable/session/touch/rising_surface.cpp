// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/rising_surface.hpp"

#include "palpable/haptics/tick/tick_options.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::session {
namespace {

using models::Relief;

/// Pictures that come more slowly lift it no more at a time.
constexpr double kLongest_s = 0.1;
/// So far around a hand the surface rises like at the hand itself.
constexpr double kAround_m = 0.004;
/// A ball that is higher above the coming surface does not feel it.
constexpr double kClear_m = 0.001;

/// How high a surface at `shown_m` that is on its way to `coming_m` may be in the next picture under a ball
/// whose lowest point is at `ball_m`: it comes to the ball at once, and then rises by at most `rise_m` in the
/// time of a picture.
double risen_m(double shown_m, double coming_m, double ball_m, double rise_m) {
  if (shown_m >= ball_m) return shown_m + rise_m;
  if (coming_m <= ball_m) return coming_m;
  // What is left of the picture's time when it meets the ball.
  const double left = (coming_m - ball_m) / (coming_m - shown_m);
  return ball_m + left * rise_m;
}

/// Lowers `height_m` around a hand to what may have risen; whether it was higher anywhere.
bool lower_around(Vec3 hand_m, double radius_m, const Relief& shown, double rise_m, Raster<float>& height_m) {
  const double pixel_m = shown.pixel_m();
  const double middle_x = 0.5 * (height_m.width() - 1), middle_y = 0.5 * (height_m.height() - 1);
  bool is_lower = false;
  for (int j = 0; j < height_m.height(); ++j)
    for (int i = 0; i < height_m.width(); ++i) {
      const double away_m =
          std::hypot(pixel_m * (i - middle_x) - hand_m.x, pixel_m * (middle_y - j) - hand_m.y);
      const double risen = risen_m(shown.samples_m()(i, j), height_m(i, j), hand_m.z - radius_m, rise_m);
      const auto most = static_cast<float>(risen + std::max(0.0, away_m - kAround_m));
      if (!(height_m(i, j) > most)) continue;
      height_m(i, j) = most;
      is_lower = true;
    }
  return is_lower;
}

}  // namespace

std::shared_ptr<const Relief> risen_surface(const Relief& shown, std::shared_ptr<const Relief> coming,
                                            std::span<const Point<SceneFrame>> hands, double radius_m,
                                            double passed_s) {
  const auto& now = shown.samples_m();
  const auto& next = coming->samples_m();
  if (now.width() != next.width() || now.height() != next.height() || shown.pixel_m() != coming->pixel_m())
    return coming;
  const double rise_m = haptics::kLift_m_per_s * std::clamp(passed_s, 0.0, kLongest_s);
  Raster<float> height_m;
  bool is_lower = false;
  for (const auto& hand : hands) {
    const double clear_m = radius_m + kClear_m;
    if (!is_finite(hand.v) || hand.v.z > coming->sample(hand.v.x, hand.v.y).z_m + clear_m) continue;
    if (height_m.count() == 0) height_m = next;
    is_lower = lower_around(hand.v, radius_m, shown, rise_m, height_m) || is_lower;
  }
  if (!is_lower) return coming;
  auto risen = Relief::from_samples(std::move(height_m), coming->pixel_m());
  return risen ? std::make_shared<const Relief>(*std::move(risen)) : coming;
}

}  // namespace palpable::session
