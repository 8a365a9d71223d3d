// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>

namespace palpable::haptics {

/// The hand at one tick, in the scene's frame.
struct Hand {
  Point<SceneFrame> position;
  /// Relative to the surface, if that moves.
  Vector<SceneFrame> velocity_m_per_s;
  double dt_s = 0.001;
  /// Orientation of the handle, scene_from_tool, and its angular velocity; for devices with torque.
  device::Rotation rotation = device::kIdentityRotation;
  Vector<SceneFrame> angular_velocity_rad_per_s = {};
  /// Time from the reading to the middle of the interval in which the motors hold the resulting force: the
  /// device's delay plus half a tick. 0 if no loop holds a force.
  double acts_after_s = 0.0;
  /// The expected change of the velocity until then, as far as the acceleration of the last ticks tells it.
  Vector<SceneFrame> gains_m_per_s = {};
};

/// By how much the hand will move faster along `outward` when the force acts; >= 0. A damper at that velocity
/// does not push out a hand that turns by itself: its force would help the hand on its way out.
inline double speeds_up(const Hand& hand, Vec3 outward) noexcept {
  return std::max(0.0, dot(hand.gains_m_per_s.v, outward));
}

/// The result of a law in one tick, before caps, ramps and passivity control.
struct LawOutput {
  Vector<SceneFrame> force_N;
  /// The proxy's position on the surface. Valid only if has_proxy.
  Point<SceneFrame> proxy;
  /// Energy that the law stores now and may return: ½K·d² for a spring (0 out of contact), k_g·z for a weight
  /// on a slope. Only differences matter. It lets the observer (passivity.hpp) distinguish returned energy
  /// from generated energy. NaN for a law without a potential.
  double stored_J = std::numeric_limits<double>::quiet_NaN();
  /// The part of the force that derives from this energy: minus its gradient, without dampers. 0 if no energy
  /// is stored.
  Vector<SceneFrame> spring_N;
  /// Torque about the hand's position; and the part of it that derives from the stored energy: minus its
  /// derivative with respect to rotation.
  Vector<SceneFrame> torque_Nm;
  Vector<SceneFrame> spring_torque_Nm;
  /// The part of the force that pulls along a way; a limited reserve supplies its energy (route_pull.hpp).
  Vector<SceneFrame> guide_N;
  /// What that pull may give to the hand in a touch, J; 0 if there is none.
  double guide_reserve_J = 0.0;
  bool contact = false;
  bool has_proxy = false;
  /// Index of the touched material or region.
  std::uint16_t label = 0;
};

}  // namespace palpable::haptics
