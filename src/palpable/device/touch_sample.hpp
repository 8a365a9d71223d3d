// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"

#include <cstdint>

namespace palpable::device {

/// The data of one tick, as displayed and recorded.
struct TouchSample {
  std::uint64_t tick = 0;
  /// Time since the loop began, and since the previous tick.
  double t_s = 0.0;
  double dt_s = 0.0;
  /// The raw reading, before any plausibility check: may be NaN.
  Point<DeviceFrame> device_position;
  Point<SceneFrame> position;
  Vector<SceneFrame> velocity_m_per_s;
  /// Valid only with haptics::flag::kHasProxy.
  Point<SceneFrame> proxy;
  /// The law's force, before caps, ramps and passivity control.
  Vector<SceneFrame> raw_force_N;
  /// The force written to the device, rotated into the scene frame.
  Vector<SceneFrame> written_force_N;
  /// The passivity observer's balance (passivity.hpp): the energy that the hand received plus the energy that
  /// the law stores.
  double energy_J = 0.0;
  std::uint32_t flags = 0;
  std::uint32_t buttons = 0;
  /// Id of the rendered haptic scene (haptics/tick/servo_types.hpp).
  std::uint32_t scene_id = 0;
  std::uint16_t label = 0;
  Status status = Status::ok;
  /// 0: the hand; others: further probes (haptics/servo/servo_loop.hpp).
  std::uint8_t probe = 0;

  /// Id of the scene that fades in after this tick; 0: none.
  std::uint32_t coming_scene_id = 0;
  /// For devices with torque: the orientation as read, and the values that the law received. Torques are
  /// about the handle's origin.
  Rotation device_rotation = kIdentityRotation;
  Vector<SceneFrame> angular_velocity_rad_per_s;
  Vector<SceneFrame> raw_torque_Nm;
  Vector<SceneFrame> written_torque_Nm;

  bool has(std::uint32_t wanted) const { return (flags & wanted) != 0; }
  bool operator==(const TouchSample&) const = default;
};

}  // namespace palpable::device
