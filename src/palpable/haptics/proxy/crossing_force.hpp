// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/proxy/proxy_force.hpp"

namespace palpable::haptics {

/// The contact of a crest or edge that the hand cut within this tick, and over which the proxy slid to the
/// hand: at the place where the hand entered it. The spring was compressed by no more than the depth of the
/// cut, and acts against the hand's way. `proxy`: a SurfaceProxy or FieldProxy with crossed_m > 0. Tick path.
template <class Proxy>
void add_crossing(const Hand& hand, const Contact& contact, const Proxy& proxy, LawOutput& output) noexcept {
  output.contact = true;
  output.proxy.v = proxy.crossed_at_m;
  output.force_N.v = contact.stiffness_N_per_m * proxy.crossed_m * unit(output.proxy.v - hand.position.v);
  output.spring_N = output.force_N;
  output.stored_J = 0.5 * contact.stiffness_N_per_m * proxy.crossed_m * proxy.crossed_m;
}

}  // namespace palpable::haptics
