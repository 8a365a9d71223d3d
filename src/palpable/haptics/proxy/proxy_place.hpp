// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstdint>

namespace palpable::haptics {

/// The proxy of a touch on a height field: a point that follows the hand but stays on or above the surface.
/// In free air it is at the hand. In contact it is the surface point nearest to the hand that it can reach by
/// sliding (god-object, Zilles & Salisbury 1995; Ruspini 1997), held back by a friction cone. All zero = a
/// new touch.
struct SurfaceProxy {
  enum class Phase : std::uint8_t {
    fresh,
    /// Above the surface, at the hand (or, after a jump too long for one tick, on its way there).
    free,
    touching
  };

  Vec3 place_m;
  /// The hand's position in the previous tick.
  Vec3 hand_m;
  /// The surface at place_m; valid only while touching.
  models::PairedSample surface;
  /// A lower bound of the height of place_m above the surface; valid only while free.
  double clearance_m = 0.0;
  Phase phase = Phase::fresh;
  /// The previous tick moved the proxy against friction: the dynamic coefficient applies.
  bool slipping = false;
  /// The share of the longest step that last brought the proxy nearer; 0 = all of it. It is kept between
  /// ticks, since at a sharp kink one tick may not have enough evaluations to find a step that is short
  /// enough.
  double step_share = 0.0;

  /// A place of the hand that is known to be under the surface, and how deep (straight down): a hand near it
  /// needs no evaluation to know that it is not in the air.
  Vec3 under_at_m;
  double under_m = 0.0;

  /// How deep the hand was in this tick, if its path cut a crest over which the proxy slid to the hand, which
  /// is in the air; else 0. And where it entered it.
  double crossed_m = 0.0;
  Vec3 crossed_at_m;

  bool holds_the_hand() const noexcept { return phase == Phase::touching; }

  /// Takes the proxy off the surface, where it is.
  void lift_off() noexcept {
    phase = Phase::free;
    clearance_m = 0.0;
  }

  /// Puts the proxy in contact on the surface, of which `s` is the sample at x_m, y_m.
  void rest(double x_m, double y_m, const models::PairedSample& s) noexcept {
    place_m = {x_m, y_m, s.z_m};
    surface = s;
    phase = Phase::touching;
  }
};

}  // namespace palpable::haptics
