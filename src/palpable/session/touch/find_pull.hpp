// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/place.hpp"
#include "palpable/device/device.hpp"
#include "palpable/models/scene/scene.hpp"

#include <memory>

namespace palpable::session {

/// A gentle pull towards a place that is looked for: a guide straight to it (models::RouteGuide), so the
/// pull acts in contact only, its energy is bounded, and all limits of the servo apply. One thread.
class FindPull {
 public:
  /// The greatest pull, and its greatest share of what the device can give.
  static constexpr double kForce_N = 0.3;
  static constexpr double kShareOfDevice = 0.2;
  /// A person who moves the hand this much farther away than it was ends the pull; a share of the scene's
  /// longer side.
  static constexpr double kPushedAway = 0.08;

  /// The guide of a hand at `from`, with at most `force_N`; null for a device without motors, and for a place
  /// that is here.
  std::shared_ptr<const models::RouteGuide> begin(const models::Scene& scene, const device::Traits& device,
                                                  Place from, Place to, double force_N = kForce_N);
  /// Whether the person has pushed the hand away from the place, which ends the pull. `from`: where it is.
  bool is_pushed_away(const models::Scene& scene, Place from);
  void end() { pulls_ = false; }
  bool pulls() const { return pulls_; }

 private:
  bool pulls_ = false;
  Place to_;
  double least_m_ = 0.0;
};

}  // namespace palpable::session
