// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/safety/limits.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Lets a force grow only so fast (cap_rise), and stays passive, also under the ramp of a touch's beginning.
/// While the growth of a spring's force is held back, the hand presses against less than the spring, gives
/// less than the spring takes as stored, and would get the whole back. So what was withheld, H of U stored,
/// is counted until the contact ends, and a hand that moves out meets (1 - H/U) of the spring, which gives
/// back U - H. The share follows the movement, out and in, over a twentieth of the depth: a hand at rest
/// meets the whole spring, and nothing chatters. Tick path; no allocation.
class RiseLimit {
 public:
  struct Input {
    /// Wanted now, after cap and ramp.
    Vector<DeviceFrame> force_N;
    /// The part of it that is a spring's, and what the spring stores now; NaN where the law has no spring:
    /// then nothing is counted.
    Vector<DeviceFrame> spring_N;
    double stored_J = 0.0;
    /// The force that the motors held since the last call, and the movement under it.
    Vector<DeviceFrame> held_force_N;
    Vector<DeviceFrame> moved_m;
    double max_rise_N = 0.0;
    /// The ramp holds the spring back: what it stores grows without the hand's work.
    bool ramping = false;
    /// What the held torque gave the hand over the turn since the last call, and what the spring's own torque
    /// would have; 0 of devices without torque.
    double turned_J = 0.0;
    double spring_turned_J = 0.0;
  };

  Limited<DeviceFrame> limit(const Input& in) noexcept {
    const bool has_spring = in.stored_J > 0.0 && norm(in.spring_N) > 0.0;
    if (!has_spring) {
      share_ = 1.0;
      withheld_J_ = 0.0;
    }
    // What the spring took as stored and the hand did not give.
    const double unpaid_J =
        has_spring ? dot(in.held_force_N, in.moved_m) + in.turned_J + in.stored_J - stored_J_ : 0.0;
    const bool counts = in.ramping || was_limited_ || withheld_J_ > 0.0;
    if (counts) count(unpaid_J);
    if (has_spring) follow(in);
    Limited<DeviceFrame> risen = cap_rise(share_ * in.force_N, force_N_, in.max_rise_N);
    // The tick in which the limit first acts has an unpaid part too: that of the way into the surface.
    if (has_spring && risen.limited && !counts) count(unpaid_J);
    was_limited_ = risen.limited;
    risen.limited = risen.limited || share_ < 1.0;
    force_N_ = risen.force_N;
    stored_J_ = has_spring ? in.stored_J : 0.0;
    return risen;
  }

  /// The controller made the force smaller than limit() gave it.
  void weakened_to(Vector<DeviceFrame> force_N) noexcept { force_N_ = force_N; }

  /// The motors hold nothing any more.
  void reset() noexcept { *this = {}; }

  /// Another part of the same spring, a torque, was held back after limit().
  void note_limited() noexcept { was_limited_ = true; }
  /// The part of a spring that is rendered now.
  double share() const noexcept { return share_; }
  double withheld_J() const noexcept { return withheld_J_; }

 private:
  /// The part of the depth over which the share follows.
  static constexpr double kFollowing = 0.05;

  void count(double unpaid_J) noexcept { withheld_J_ = std::max(0.0, withheld_J_ + unpaid_J); }

  void follow(const Input& in) noexcept {
    const double spring_N = norm(in.spring_N);
    const double out_m = (dot(in.spring_N, in.moved_m) + in.spring_turned_J) / spring_N;
    const double goal = out_m > 0.0 ? std::clamp(1.0 - withheld_J_ / in.stored_J, 0.0, share_) : 1.0;
    // A spring that stores U at a force f is 2 U / f deep.
    const double over_m = kFollowing * 2.0 * in.stored_J / spring_N;
    share_ += (goal - share_) * std::min(1.0, std::abs(out_m) / over_m);
    if (out_m > 0.0 && withheld_J_ >= in.stored_J) share_ = 0.0;
  }

  Vector<DeviceFrame> force_N_;
  double stored_J_ = 0.0;
  double withheld_J_ = 0.0;
  double share_ = 1.0;
  bool was_limited_ = false;
};

}  // namespace palpable::haptics
