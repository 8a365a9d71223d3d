// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace palpable::haptics {

/// The hand at one tick, in the scene's frame.
struct Hand {
  Point<SceneFrame> position;
  Vector<SceneFrame> velocity_m_per_s;
  double dt_s = 0.001;
};

/// What the hand feels at one tick, before caps, ramps and passivity.
struct LawOutput {
  Vector<SceneFrame> force_N;
  /// Where the law keeps a proxy on the surface: its place. Meaningful only if has_proxy.
  Point<SceneFrame> proxy;
  /// Energy that the law stores now and may give back: ½K·d² of a spring (0 out of contact), k_g·z of a
  /// weight on a slope. Only differences count. It lets the observer (passivity.hpp) tell energy given back
  /// from energy made; a law without a potential leaves it NaN, and is not watched.
  double stored_J = std::numeric_limits<double>::quiet_NaN();
  /// The part of the force that this energy makes: minus its gradient, without dampers. 0 where none is
  /// stored.
  Vector<SceneFrame> spring_N;
  bool contact = false;
  bool has_proxy = false;
  /// Index of the material or region touched.
  std::uint16_t label = 0;
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
  /// parameters); others begin with a new one.
  virtual std::uint64_t state_family() const noexcept = 0;
  /// Viscous damping the law promises to take out when in contact, in N·s/m: the passivity observer's
  /// reserve.
  virtual double damping_Ns_per_m() const noexcept = 0;
  /// Reads every page of the model once, before it is swapped in.
  virtual void touch_pages() const noexcept = 0;
  /// What the ticks read: the model, and what the law made of it beforehand.
  virtual std::size_t memory_bytes() const noexcept { return 0; }
};

}  // namespace palpable::haptics
