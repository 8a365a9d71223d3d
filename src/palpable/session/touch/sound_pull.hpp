// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/place.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/session/touch/find_pull.hpp"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace palpable::session {

/// The place of a scene, which shows what a camera sees, on the band of a sound's direction
/// (mark_direction()) that is nearest to a hand. nullopt: the direction is not in the picture.
std::optional<Place> sound_place(const models::Relief& relief, const Pinhole& camera, double down_rad,
                                 double azimuth_rad, Place hand);

/// A faint pull towards the direction of a sound (Park & Howard's future work): FindPull's, with less force,
/// once for each sound. One thread.
class SoundPull {
 public:
  static constexpr double kForce_N = 0.2;

  /// Where a sound is, for a hand.
  using PlaceOf = std::function<std::optional<Place>(Place hand)>;
  /// The guide of a scene that is handed over next, and begins or ends the pull. `sounds`: how many were
  /// heard; `is_heard`: the newest one is still marked. A scene that has a guide of somebody else keeps it.
  std::shared_ptr<const models::RouteGuide> guide(const models::Scene& scene, const device::Traits& device,
                                                  Place hand, std::uint64_t sounds, bool is_heard,
                                                  const PlaceOf& place_of);
  /// Once, a sentence that it began or ended.
  std::optional<std::string> words();

 private:
  FindPull pull_;
  /// Its own guide, which may be in a scene for longer than it pulls.
  std::shared_ptr<const models::RouteGuide> own_;
  std::uint64_t pulled_ = 0;
  std::optional<std::string> words_;
};

}  // namespace palpable::session
