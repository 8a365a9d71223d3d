// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"

#include <cstdint>

namespace palpable::device {

/// Everything about one tick: what the page shows and what a recording holds.
struct TouchSample {
  std::uint64_t tick = 0;
  /// Since the loop began; and since the tick before.
  double t_s = 0.0;
  double dt_s = 0.0;
  /// As read, before any plausibility check: may be NaN.
  Point<DeviceFrame> device_position;
  Point<SceneFrame> position;
  Vector<SceneFrame> velocity_m_per_s;
  /// Meaningful only with haptics::flag::kHasProxy.
  Point<SceneFrame> proxy;
  /// The law's, before caps, ramps and passivity.
  Vector<SceneFrame> raw_force_N;
  /// As written to the device, turned into the scene's frame.
  Vector<SceneFrame> written_force_N;
  /// The observer's balance (passivity.hpp): what the hand received, with what the law still stores.
  double energy_J = 0.0;
  std::uint32_t flags = 0;
  std::uint32_t buttons = 0;
  /// Which haptic scene was rendered (haptics/servo/servo_types.hpp).
  std::uint32_t scene_id = 0;
  std::uint16_t label = 0;
  Status status = Status::ok;
  /// 0: the hand's own; others: of several probes at once (haptics/servo/servo_loop.hpp).
  std::uint8_t probe = 0;

  /// The scene that fades in, after this tick; 0: none.
  std::uint32_t coming_scene_id = 0;
  /// Of devices with torque; as read, and as the law was given it. Torques about the handle's origin.
  Rotation device_rotation = kNotTurned;
  Vector<SceneFrame> angular_velocity_rad_per_s;
  Vector<SceneFrame> raw_torque_Nm;
  Vector<SceneFrame> written_torque_Nm;

  bool has(std::uint32_t wanted) const { return (flags & wanted) != 0; }
  bool operator==(const TouchSample&) const = default;
};

}  // namespace palpable::device
