// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/touchable.hpp"

namespace palpable::haptics {

/// Evaluates the tick that is to be expected after one with the hand `last`, which goes on at its velocity,
/// with a copy of the state after it, and discards the result. Afterwards what that tick reads is in the
/// processor's caches, and its decisions are known to the processor's predictors; both are lost while a loop
/// sleeps. Of the state it keeps only TouchState::found, so no result changes. Tick path.
inline void rehearse(const Touchable& touchable, const Hand& last, TouchState& state) noexcept {
  Hand next = last;
  next.position = last.position + last.dt_s * last.velocity_m_per_s;
  TouchState copy = state;
  touchable.evaluate(next, copy);
  state.found = copy.found;
}

}  // namespace palpable::haptics
