// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/proxy_force.hpp"

namespace palpable::haptics {

/// State that a touch passes to another surface or law: the proxy's position and contact.
struct HandOver {
  /// Whether there is a proxy, at `place`; if not, the rest is unused.
  bool has_proxy = false;
  /// The proxy was in contact.
  bool touching = false;
  bool slipping = false;
  Point<SceneFrame> place;
  /// Outward unit normal of the surface there; valid only while touching.
  Vector<SceneFrame> normal;
  /// The hand's position in the previous tick.
  Point<SceneFrame> hand;
  ContactMemory memory;
};

/// Makes a HandOver from a SurfaceProxy or a FieldProxy, with the surface's outward unit normal at it. Tick
/// path.
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
