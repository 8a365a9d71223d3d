// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <cmath>

namespace palpable::device {

/// The handle of a virtual device in three axes: a mass that a hand's spring pulls to a place.
struct MovedHandle {
  static constexpr double kMass_kg = 0.2;
  static constexpr double kDamping_Ns_per_m = 6.0;
  static constexpr double kStiffness_N_per_m = 120.0;
  static constexpr double kSensorStep_m = 1e-5;

  Vec3 position_m;
  Vec3 velocity_m_per_s;
  Vec3 goal_m;

  void move(Vec3 force_N, double dt_s) {
    const Vec3 pull =
        kStiffness_N_per_m * (goal_m - position_m) - kDamping_Ns_per_m * velocity_m_per_s + force_N;
    velocity_m_per_s = velocity_m_per_s + (dt_s / kMass_kg) * pull;
    position_m = position_m + dt_s * velocity_m_per_s;
  }
  /// The position in steps of the sensor.
  Vec3 measured_m() const {
    const auto in_steps = [](double value) { return kSensorStep_m * std::round(value / kSensorStep_m); };
    return {in_steps(position_m.x), in_steps(position_m.y), in_steps(position_m.z)};
  }
};

/// Faults of the virtual vendors' libraries.
enum class LibraryFault : int {
  none = 0,
  /// Positions cannot be read; forces are taken.
  unreadable = 1,
  /// Positions that are no numbers.
  not_finite = 2,
  /// Positions metres away.
  far_away = 3,
  /// The device was unplugged: every call fails, and the motors are free.
  unplugged = 4,
  /// There is no device, or the one that was asked for.
  absent = 5,
  /// The position is not known until the user or the motors have moved the handle.
  uncalibrated = 6
};

}  // namespace palpable::device
