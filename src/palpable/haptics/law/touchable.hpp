// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/law/hand_over.hpp"
#include "palpable/haptics/law/law_output.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace palpable::haptics {

/// What the passivity observer knows of a law's energy.
enum class EnergyModel : std::uint8_t {
  /// No potential: the plain work of each contact that begins in free air is counted.
  none,
  /// LawOutput::stored_J is the energy of a contact spring, 0 out of contact.
  spring,
  /// stored_J is a potential that holds everywhere, as of a weight on a slope.
  weight,
  /// The law gives energy on purpose and bounds it itself: observed, not controlled.
  self_limited
};

/// All memory of one touch: owned by the servo loop, trivially copyable, given to the law as bytes. A law's
/// own State lives at its start (state_as). All zero = a new touch at rest.
struct TouchState {
  alignas(16) std::array<std::byte, 240> bytes{};
};

/// A law's State inside a TouchState. State is trivially copyable, at most 240 bytes, and all-zero is its
/// start.
template <class State>
State& state_as(TouchState& state) noexcept {
  static_assert(std::is_trivially_copyable_v<State> && sizeof(State) <= sizeof(TouchState::bytes));
  return *reinterpret_cast<State*>(state.bytes.data());
}

template <class State>
const State& state_as(const TouchState& state) noexcept {
  static_assert(std::is_trivially_copyable_v<State> && sizeof(State) <= sizeof(TouchState::bytes));
  return *reinterpret_cast<const State*>(state.bytes.data());
}

/// Surface + law + effects: what the servo loop asks, once a tick. Immutable; a change of parameters is a new
/// Touchable.
class Touchable {
 public:
  Touchable() = default;
  Touchable(const Touchable&) = delete;
  Touchable& operator=(const Touchable&) = delete;
  virtual ~Touchable() = default;

  /// Tick path: no allocation, lock, exception or output. `hand` is finite.
  virtual LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept = 0;
  /// Touchables of the same family continue each other's TouchState (same law on the same surface, other
  /// parameters); others take over what they can.
  virtual std::uint64_t state_family() const noexcept = 0;
  /// What a touch can take along to another Touchable; and the start of a touch that brings it, in a state
  /// that is all zero. Tick path.
  virtual HandOver hand_over(const TouchState& /*state*/) const noexcept { return {}; }
  virtual void take_over(const HandOver& /*from*/, TouchState& /*state*/) const noexcept {}
  virtual EnergyModel energy_model() const noexcept { return EnergyModel::none; }
  /// Viscous damping the law promises to take out when in contact, in N·s/m: the passivity observer's
  /// reserve.
  virtual double damping_Ns_per_m() const noexcept = 0;
  /// Reads every page of the model once, before it is swapped in.
  virtual void touch_pages() const noexcept = 0;
  /// What the ticks read: the model, and what the law made of it beforehand.
  virtual std::size_t memory_bytes() const noexcept { return 0; }
};

}  // namespace palpable::haptics
