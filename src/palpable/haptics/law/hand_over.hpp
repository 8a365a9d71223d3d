// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/proxy_force.hpp"

namespace palpable::haptics {

/// What a touch takes along to another surface or law: where its proxy was, and how it held the hand.
struct HandOver {
  /// There was a proxy, at `place`; false: there is nothing to take along.
  bool has_proxy = false;
  /// It held the hand.
  bool touching = false;
  bool slipping = false;
  Point<SceneFrame> place;
  /// Out of the surface there, unit; only when touching.
  Vector<SceneFrame> normal;
  /// The hand in the last tick.
  Point<SceneFrame> hand;
  ContactMemory memory;
};

/// Of a SurfaceProxy or a FieldProxy with the surface's outward unit normal at it. Tick path.
template <class Proxy>
HandOver hand_over_of(const Proxy& proxy, Vec3 normal, const ContactMemory& memory) noexcept {
  using Phase = typename Proxy::Phase;
  return {proxy.phase != Phase::fresh,
          proxy.phase == Phase::touching,
          proxy.slipping,
          {proxy.place_m},
          {normal},
          {proxy.hand_m},
          memory};
}

}  // namespace palpable::haptics
