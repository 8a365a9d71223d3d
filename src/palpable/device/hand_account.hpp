// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/potential_account.hpp"

#include <algorithm>

namespace palpable::device {

/// What the forces of surfaces that another computer sends may still give to the hand, J. It counts the work
/// of all forces on the hand, whatever they were made of, and believes nothing that is sent: what the hand
/// gave may come back to it, and one reserve beyond that, once. Three kinds of force have three ends. Slopes
/// give only what the hand gave before (and kFirst_J, once). Pulls, for which a hand gives nothing before,
/// end with the reserve. Planes, which are passive by themselves (haptics/law/local_touch.hpp), end kPlanes_J
/// later: they do so only where surfaces are sent to push a hand. Tick path.
class HandAccount {
 public:
  /// The most of what the hand gave that is remembered: more than it presses into a plane. What it gives
  /// beyond fills the reserve.
  static constexpr double kMostGiven_J = 0.3;
  static constexpr double kReserve_J = 0.02;
  static constexpr double kPlanes_J = 0.02;
  static constexpr double kFirst_J = 2e-5;

  /// Of slopes, besides.
  PotentialAccount potential;

  /// Work of the device's force on the hand since the last call, with the present time, seconds.
  void add(double work_J, double now_s) noexcept {
    potential.add(work_J, now_s);
    given_J_ -= work_J;
    const double beyond_J = given_J_ - std::clamp(given_J_, 0.0, kMostGiven_J);
    given_J_ -= beyond_J;
    reserve_J_ = std::min(kReserve_J, reserve_J_ + beyond_J);
  }

  /// The part of a slope's force that may act, 0 ... 1, if all of it gives so much to the hand. It leaves
  /// enough for kSlopeLasts_s.
  double slope_share(double gives_W) const noexcept {
    constexpr double kSlopeLasts_s = 0.02;
    const double left_J = std::clamp(potential.left_J() + kFirst_J, 0.0, given_J_);
    const double least = gives_W * kSlopeLasts_s > left_J ? left_J / (gives_W * kSlopeLasts_s) : 1.0;
    return least * plane_share();
  }
  double pull_share() const noexcept { return share_of(given_J_ + reserve_J_); }
  double plane_share() const noexcept { return share_of(given_J_ + reserve_J_ + kPlanes_J); }

 private:
  static double share_of(double left_J) noexcept {
    constexpr double kWeakerFrom_J = 2e-3;
    return std::clamp(left_J / kWeakerFrom_J, 0.0, 1.0);
  }

  double given_J_ = kFirst_J;
  /// Below 0 where planes give more than the hand gave.
  double reserve_J_ = kReserve_J;
};

}  // namespace palpable::device
