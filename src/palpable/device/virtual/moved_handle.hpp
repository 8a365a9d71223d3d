// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <random>

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
  uncalibrated = 6,
  /// Positions anywhere in the workspace.
  garbage = 7,
  /// The position of before the fault again and again.
  stuck = 8,
  /// Every second position cannot be read.
  dropped = 9,
  /// Each second position is the one of before.
  reordered = 10,
  /// Positions beside the true ones.
  shifted = 11
};

/// What the virtual vendors' libraries say of a handle's position under a fault, m.
class LibrarySensor {
 public:
  /// nullopt: it cannot be read.
  std::optional<Vec3> measure(const MovedHandle& handle, LibraryFault fault) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const Vec3 now_m = handle.measured_m();
    ++readings_;
    const bool is_second = readings_ % 2 == 0;
    switch (fault) {
      case LibraryFault::unreadable:
        return std::nullopt;
      case LibraryFault::dropped:
        return is_second ? std::nullopt : std::optional(now_m);
      case LibraryFault::not_finite:
        return Vec3{now_m.x, kNaN, now_m.z};
      case LibraryFault::far_away:
        return now_m + Vec3{3.0, 3.0, 3.0};
      case LibraryFault::garbage:
        return Vec3{anywhere(), anywhere(), anywhere()};
      case LibraryFault::shifted:
        return now_m + Vec3{0.02, -0.02, 0.01};
      case LibraryFault::stuck:
        return last_m_;
      case LibraryFault::reordered:
        if (is_second) return before_m_;
        break;
      default:
        break;
    }
    before_m_ = last_m_;
    return last_m_ = now_m;
  }

 private:
  double anywhere() {
    constexpr double kHalf_m = 0.05;
    return std::uniform_real_distribution<double>(-kHalf_m, kHalf_m)(random_);
  }
  Vec3 last_m_;
  Vec3 before_m_;
  unsigned readings_ = 0;
  std::mt19937 random_{7};
};

}  // namespace palpable::device
