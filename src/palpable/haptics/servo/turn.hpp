// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/servo/velocity.hpp"

namespace palpable::haptics {

/// The turn that brings one orientation to another, as a vector along its axis, as long as its angle in rad
/// (0 ... pi), in the frame that both are given in. Tick path.
Vector<DeviceFrame> turn_between(const device::Rotation& from, const device::Rotation& to) noexcept;

/// Scene from tool: of a handle's orientation and the device's place in the scene. Tick path.
device::Rotation turned_by(const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                           const device::Rotation& device_from_tool) noexcept;

/// Whether it is finite and orthonormal, determinant +1, to a thousandth. Tick path.
bool is_rotation(const device::Rotation& rotation) noexcept;

/// How a handle is turned, from tick to tick, and how fast: the slope of the angles that it turned by
/// (VelocityEstimator). Tick path.
class TurnEstimator {
 public:
  /// The next orientation is the first.
  void begin() noexcept {
    known_ = false;
    velocity_.begin();
    turned_ = {};
    velocity_rad_per_s_ = {};
  }
  void update(const device::Rotation& rotation, double dt_s) noexcept;

  const device::Rotation& rotation() const noexcept { return rotation_; }
  /// By the last update.
  Vector<DeviceFrame> turned_rad() const noexcept { return turned_; }
  Vector<DeviceFrame> velocity_rad_per_s() const noexcept { return velocity_rad_per_s_; }
  bool known() const noexcept { return known_; }

 private:
  device::Rotation rotation_ = device::kNotTurned;
  bool known_ = false;
  Vector<DeviceFrame> turned_;
  Vector<DeviceFrame> velocity_rad_per_s_;
  /// All turns added up.
  Point<DeviceFrame> angle_;
  VelocityEstimator velocity_{0.0};
};

}  // namespace palpable::haptics
