// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"

#include <cstdint>
#include <limits>

namespace palpable::haptics {

/// The hand at one tick, in the scene's frame.
struct Hand {
  Point<SceneFrame> position;
  Vector<SceneFrame> velocity_m_per_s;
  double dt_s = 0.001;
  /// How a handle is turned, scene from tool, and how fast; of devices with torque.
  device::Rotation rotation = device::kNotTurned;
  Vector<SceneFrame> angular_velocity_rad_per_s = {};
  /// From the reading to the middle of the time for which the motors hold the force that answers it: the
  /// device's delay and half a tick. 0 where no loop holds a force.
  double acts_after_s = 0.0;
};

/// What a law renders at one tick, before caps, ramps and passivity.
struct LawOutput {
  Vector<SceneFrame> force_N;
  /// Where the law keeps a proxy on the surface: its place. Meaningful only if has_proxy.
  Point<SceneFrame> proxy;
  /// Energy that the law stores now and may give back: ½K·d² of a spring (0 out of contact), k_g·z of a
  /// weight on a slope. Only differences count. It lets the observer (passivity.hpp) distinguish energy given
  /// back from energy made; a law without a potential leaves it NaN.
  double stored_J = std::numeric_limits<double>::quiet_NaN();
  /// The part of the force that this energy makes: minus its gradient, without dampers. 0 where none is
  /// stored.
  Vector<SceneFrame> spring_N;
  /// About the hand's position, and the part of it that the stored energy makes: minus its derivative by the
  /// turn.
  Vector<SceneFrame> torque_Nm;
  Vector<SceneFrame> spring_torque_Nm;
  bool contact = false;
  bool has_proxy = false;
  /// Index of the material or region touched.
  std::uint16_t label = 0;
};

}  // namespace palpable::haptics
