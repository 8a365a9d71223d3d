// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/local_surface.hpp"
#include "palpable/haptics/effect/law_output.hpp"
#include "palpable/haptics/effect/material_map.hpp"
#include "palpable/haptics/effect/route_pull.hpp"
#include "palpable/haptics/proxy/found_in_field.hpp"
#include "palpable/haptics/proxy/hand_over.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace palpable::haptics {

/// How the passivity observer treats a law's energy.
enum class EnergyModel : std::uint8_t {
  /// No potential: the work of each contact that begins in free air is counted.
  none,
  /// LawOutput::stored_J is the energy of a contact spring, 0 out of contact.
  spring,
  /// stored_J is a potential defined everywhere, such as that of a weight on a slope.
  weight,
  /// The law generates energy on purpose and limits it itself: observed, not controlled.
  self_limited
};

/// The complete state of one touch. The servo loop owns it; it is trivially copyable and passed to the law as
/// bytes. A law's own State is at its start (state_as). All zero = a new touch at rest.
struct TouchState {
  alignas(16) std::array<std::byte, 256> bytes{};
  /// That of a pull along a way, which any law can have beside it.
  PullTouch pull{};
  FoundInField found{};
};

/// A law's State inside a TouchState. State must be trivially copyable and at most 256 bytes; all zero is its
/// initial value.
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

/// The plane that touches a surface near the hand.
struct TangentPlane {
  bool is_known = false;
  /// A point on it, and its outward unit normal.
  Point<SceneFrame> place;
  Vector<SceneFrame> normal;
  Contact contact;
  /// The label of a texture that is added to it; none if negative.
  int texture = -1;
  device::LaidTexture::Onto onto = device::LaidTexture::Onto::plan;
};

/// A surface with a law and effects, which the servo loop evaluates once per tick. Immutable; changed
/// parameters need a new Touchable.
class Touchable {
 public:
  Touchable() = default;
  Touchable(const Touchable&) = delete;
  Touchable& operator=(const Touchable&) = delete;
  virtual ~Touchable() = default;

  /// Computes the law's output for one tick. Tick path: no allocation, lock, exception or output. `hand` is
  /// finite. Changes nothing but `state`: a loop also calls it for ticks that may not come (rehearsal.hpp).
  virtual LawOutput evaluate(const Hand& hand, TouchState& state) const noexcept = 0;
  /// Touchables of the same family can continue with each other's TouchState (same law on the same surface,
  /// other parameters); others use hand_over() and take_over().
  virtual std::uint64_t state_family() const noexcept = 0;
  /// hand_over(): the state that can be passed to another Touchable. take_over(): starts a touch from such a
  /// state; `state` is all zero before. Tick path.
  virtual HandOver hand_over(const TouchState& /*state*/) const noexcept { return {}; }
  virtual void take_over(const HandOver& /*from*/, TouchState& /*state*/) const noexcept {}
  /// The plane of the surface at the proxy, or, in free air, below the hand, after evaluate() with the same
  /// hand: for devices that render it themselves (device/local_surface.hpp). Tick path.
  virtual TangentPlane tangent_plane(const Hand& /*hand*/, const TouchState& /*state*/) const noexcept {
    return {};
  }
  /// Whether the law is that of a surface, whose planes tangent_plane() knows.
  virtual bool has_tangent_planes() const noexcept { return false; }
  virtual EnergyModel energy_model() const noexcept { return EnergyModel::none; }
  /// The vibration after an impact, of a touchable that is told it from elsewhere; null: the scene's
  /// (HapticScene::transient). Tick path.
  virtual const device::ContactTransient* transient() const noexcept { return nullptr; }
  /// Viscous damping that the law guarantees in contact, N·s/m: the passivity observer's reserve.
  virtual double damping_Ns_per_m() const noexcept = 0;
  /// Reads every page of the model once, before it is used in the servo loop.
  virtual void touch_pages() const noexcept = 0;
  /// Memory that the ticks read: the model, and what the law computed from it in advance.
  virtual std::size_t memory_bytes() const noexcept { return 0; }
};

}  // namespace palpable::haptics
