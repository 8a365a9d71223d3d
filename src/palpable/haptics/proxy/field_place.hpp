// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <cstdint>

namespace palpable::haptics {

/// The proxy of a touch on a solid: a point that follows the hand and never enters the solid. All zero = a
/// new touch.
struct FieldProxy {
  enum class Phase : std::uint8_t { fresh, free, touching };
  Vec3 place_m;
  /// The hand's position in the previous tick.
  Vec3 hand_m;
  /// While touching: the surface's outward unit normal at place_m. While free: the distance's gradient there,
  /// or 0 if it is not known.
  Vec3 normal;
  /// A lower bound of the distance from place_m to the surface; valid only while free.
  double clearance_m = 0.0;
  /// As SurfaceProxy::step_share.
  double step_share = 0.0;
  /// Curvature of the surface along the last step, 1/m; positive where it is convex.
  double bend_per_m = 0.0;
  Phase phase = Phase::fresh;
  bool slipping = false;
  /// The last step of the tick was rejected, as in a crease, where the proxy is held by more than one face
  /// and the force does not point along the normal of one of them.
  bool blocked = false;
  /// As SurfaceProxy::crossed_m and crossed_at_m: a solid that the hand cut within this tick, around which
  /// the proxy slid to the hand.
  double crossed_m = 0.0;
  Vec3 crossed_at_m;

  bool holds_the_hand() const noexcept { return phase == Phase::touching; }
};

}  // namespace palpable::haptics
