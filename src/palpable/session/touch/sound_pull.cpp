// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/sound_pull.hpp"

#include "palpable/session/robot/robot_ears.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace palpable::session {

std::optional<Place> sound_place(const models::Relief& relief, const Pinhole& camera, double down_rad,
                                 double azimuth_rad, Place hand) {
  Raster<std::uint8_t> marks(camera.width, camera.height, 0);
  mark_direction(marks, 1, camera, down_rad, azimuth_rad);
  std::optional<Place> found;
  double least_m = std::numeric_limits<double>::infinity();
  for (int y = 0; y < marks.height(); ++y)
    for (int x = 0; x < marks.width(); ++x) {
      if (marks(x, y) == 0) continue;
      const Place here{relief.pixel_m() * (x - 0.5 * (marks.width() - 1)),
                       relief.pixel_m() * (0.5 * (marks.height() - 1) - y)};
      const double away_m = std::hypot(here.x_m - hand.x_m, here.y_m - hand.y_m);
      if (away_m < least_m) found = here, least_m = away_m;
    }
  return found;
}

std::shared_ptr<const models::RouteGuide> SoundPull::guide(const models::Scene& scene,
                                                           const device::Traits& device, Place hand,
                                                           std::uint64_t sounds, bool is_heard,
                                                           const PlaceOf& place_of) {
  if (scene.guide && scene.guide != own_) {
    pull_.end();
    return scene.guide;
  }
  if (pull_.pulls() && pull_.is_pushed_away(scene, hand)) {
    pull_.end();
    words_ = "The pull has ended: the hand was moved away.";
  }
  // A new one begins when the scene has left the guide of the one before.
  if (!is_heard || sounds > pulled_) pull_.end();
  if (is_heard && sounds > pulled_ && !scene.guide) {
    pulled_ = sounds;
    const auto place = place_of(hand);
    auto begun = place ? pull_.begin(scene, device, hand, *place, kForce_N) : nullptr;
    if (begun) {
      own_ = std::move(begun);
      words_ = "A faint pull leads to where the sound comes from.";
    }
  }
  return pull_.pulls() ? own_ : nullptr;
}

std::optional<std::string> SoundPull::words() { return std::exchange(words_, std::nullopt); }

}  // namespace palpable::session
