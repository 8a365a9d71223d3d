// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/rotation.hpp"

#include "palpable/haptics/effect/tool_touch.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

Vector<DeviceFrame> rotation_between(const device::Rotation& from, const device::Rotation& to) noexcept {
  // to * from^T: its antisymmetric part is sin(angle) times the axis, its trace is 1 + 2 cos(angle).
  const auto at = [&](std::size_t i, std::size_t j) {
    return to[3 * i] * from[3 * j] + to[3 * i + 1] * from[3 * j + 1] + to[3 * i + 2] * from[3 * j + 2];
  };
  const Vec3 twice_sine{at(2, 1) - at(1, 2), at(0, 2) - at(2, 0), at(1, 0) - at(0, 1)};
  const double sine = 0.5 * norm(twice_sine);
  const double cosine = 0.5 * (at(0, 0) + at(1, 1) + at(2, 2) - 1.0);
  const double angle = std::atan2(sine, cosine);
  // Neither for angle 0 nor for pi is the axis determined by this part; for angle 0 the result is zero.
  constexpr double kSmall = 1e-12;
  return {sine > kSmall ? (0.5 * angle / sine) * twice_sine : Vec3{}};
}

device::Rotation rotation_in_scene(const Transform<SceneFrame, DeviceFrame>& scene_from_device,
                                   const device::Rotation& device_from_tool) noexcept {
  return (Transform<SceneFrame, DeviceFrame>{scene_from_device.rotation, {}, 1.0} *
          Transform<DeviceFrame, ToolFrame>{device_from_tool, {}, 1.0})
      .rotation;
}

bool is_rotation(const device::Rotation& rotation) noexcept {
  constexpr double kOff = 1e-3;
  const auto row = [&](std::size_t i) {
    return Vec3{rotation[3 * i], rotation[3 * i + 1], rotation[3 * i + 2]};
  };
  const Vec3 a = row(0), b = row(1), c = row(2);
  const double off =
      std::abs(dot(a, a) - 1.0) + std::abs(dot(b, b) - 1.0) + std::abs(dot(a, b)) + norm(cross(a, b) - c);
  return off < kOff;
}

void RotationEstimator::update(const device::Rotation& rotation, double dt_s) noexcept {
  rotated_ = known_ ? rotation_between(rotation_, rotation) : Vector<DeviceFrame>{};
  rotation_ = rotation;
  known_ = true;
  angle_ = angle_ + rotated_;
  velocity_rad_per_s_ = velocity_.update(angle_, dt_s);
}

}  // namespace palpable::haptics
