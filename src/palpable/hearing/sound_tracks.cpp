// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/sound_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace palpable::hearing {

void SoundTracks::add(Track& track, const HeardWindow& window, Vec3 direction) const {
  constexpr double kMost_db = 40.0;
  track.sum += window.confidence * direction;
  track.shared_power += window.shared_power;
  track.other_power += window.other_power;
  HeardSound& sound = track.sound;
  sound.end_s = window.end_s;
  sound.bearing = bearing_of({track.sum}, shape_);
  sound.confidence = std::max(sound.confidence, window.confidence);
  const double ratio = std::max(track.shared_power, 1e-20) / std::max(track.other_power, 1e-20);
  sound.snr_db = std::clamp(10.0 * std::log10(ratio), -kMost_db, kMost_db);
}

std::optional<HeardSound> SoundTracks::take(const HeardWindow& window) {
  const auto is_over = [&](const Track& track) {
    return window.begin_s - track.sound.end_s > options_.pause_s;
  };
  for (const Track& track : open_)
    if (is_over(track)) ended_.push_back(track.sound);
  std::erase_if(open_, is_over);
  if (!window.direction) return std::nullopt;
  Vec3 direction = window.direction->v;
  // The height of the direction is not determined, and must not weigh.
  if (shape_ == ArrayShape::level) direction = unit({direction.x, 0.0, direction.z});
  Track* nearest = nullptr;
  double closest = std::cos(options_.same_deg * std::numbers::pi / 180.0);
  for (Track& track : open_)
    if (const double along = dot(unit(track.sum), direction); along >= closest) {
      closest = along;
      nearest = &track;
    }
  const bool is_first = nearest == nullptr;
  if (is_first) {
    nearest = &open_.emplace_back();
    nearest->sound.begin_s = window.begin_s;
  }
  add(*nearest, window, direction);
  return is_first ? std::optional(nearest->sound) : std::nullopt;
}

std::vector<HeardSound> SoundTracks::take_ended(bool all) {
  if (all) {
    for (const Track& track : open_) ended_.push_back(track.sound);
    open_.clear();
  }
  std::ranges::stable_sort(ended_, {}, &HeardSound::end_s);
  return std::exchange(ended_, {});
}

}  // namespace palpable::hearing
