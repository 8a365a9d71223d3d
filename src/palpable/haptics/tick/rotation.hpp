// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/device/device.hpp"
#include "palpable/haptics/tick/velocity.hpp"

namespace palpable::haptics {

/// The rotation from one orientation to another as a rotation vector (axis times angle in rad, 0 ... pi), in
/// the frame in which both are given. Tick path.
Vector<DeviceFrame> rotation_between(const device::Rotation& from, const device::Rotation& to) noexcept;

/// The rotation scene_from_tool of a handle, from its orientation in the device frame and the placement of
/// the device. Tick path.
device::Rotation rotation_in_scene(const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                                   const device::Rotation& device_from_tool) noexcept;

/// Whether the matrix is finite and orthonormal with determinant +1, to 0.001. Tick path.
bool is_rotation(const device::Rotation& rotation) noexcept;

/// Estimates a handle's rotation between ticks and its angular velocity; the velocity is the slope of the
/// accumulated rotation vector (VelocityEstimator). Tick path.
class RotationEstimator {
 public:
  /// `shortest_s`: VelocityEstimator's.
  explicit RotationEstimator(double shortest_s = 0.0) : velocity_(0.0, shortest_s) {}

  /// Resets: the next orientation is the first.
  void begin() noexcept {
    known_ = false;
    velocity_.begin();
    rotated_ = {};
    velocity_rad_per_s_ = {};
  }
  void update(const device::Rotation& rotation, double dt_s) noexcept;

  const device::Rotation& rotation() const noexcept { return rotation_; }
  /// Rotation vector between the last two updates.
  Vector<DeviceFrame> rotated_rad() const noexcept { return rotated_; }
  Vector<DeviceFrame> velocity_rad_per_s() const noexcept { return velocity_rad_per_s_; }
  bool known() const noexcept { return known_; }

 private:
  device::Rotation rotation_ = device::kIdentityRotation;
  bool known_ = false;
  Vector<DeviceFrame> rotated_;
  Vector<DeviceFrame> velocity_rad_per_s_;
  /// Sum of all rotation vectors.
  Point<DeviceFrame> angle_;
  VelocityEstimator velocity_;
};

}  // namespace palpable::haptics
