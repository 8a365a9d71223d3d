// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/safety/limits.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Limits the growth of a force (cap_rise) and stays passive, also during the ramp at the start of a touch.
/// While the growth of a spring's force is limited, the hand presses against less than the spring. It
/// delivers less energy than the spring counts as stored, and would get all of it back. So the energy that
/// was withheld, H of the stored energy U, is counted until the contact ends. A hand that moves out meets the
/// share (1 - H/U) of the spring, which returns U - H. The share changes with the movement, outwards and
/// inwards, over a twentieth of the depth. So a hand at rest meets the whole spring, and the force does not
/// chatter.
/// Tick path; no allocation.
class RiseLimit {
 public:
  struct Input {
    /// The desired force after cap and ramp.
    Vector<DeviceFrame> force_N;
    /// The spring's part of force_N, and the energy that the spring stores now. NaN where the law has no
    /// spring: then nothing is counted.
    Vector<DeviceFrame> spring_N;
    double stored_J = 0.0;
    /// The force that the motors held since the last call, and the movement during that time.
    Vector<DeviceFrame> held_force_N;
    Vector<DeviceFrame> moved_m;
    double max_rise_N = 0.0;
    /// The ramp reduces the spring's force: the stored energy grows without work of the hand.
    bool ramping = false;
    /// Work on the hand since the last call: of the held torque, and of the spring's own torque. 0 for
    /// devices without torque.
    double turned_J = 0.0;
    double spring_turned_J = 0.0;
  };

  Limited<DeviceFrame> limit(const Input& in) noexcept {
    const bool has_spring = in.stored_J > 0.0 && norm(in.spring_N) > 0.0;
    if (!has_spring) {
      share_ = 1.0;
      withheld_J_ = 0.0;
    }
    // Energy that the spring counts as stored but the hand did not deliver.
    const double unpaid_J =
        has_spring ? dot(in.held_force_N, in.moved_m) + in.turned_J + in.stored_J - stored_J_ : 0.0;
    const bool counts = in.ramping || was_limited_ || withheld_J_ > 0.0;
    if (counts) count(unpaid_J);
    if (has_spring) follow(in);
    Limited<DeviceFrame> risen = cap_rise(share_ * in.force_N, force_N_, in.max_rise_N);
    // The tick in which the limit first acts has undelivered energy too: that of the movement into the
    // surface.
    if (has_spring && risen.limited && !counts) count(unpaid_J);
    was_limited_ = risen.limited;
    risen.limited = risen.limited || share_ < 1.0;
    force_N_ = risen.force_N;
    stored_J_ = has_spring ? in.stored_J : 0.0;
    return risen;
  }

  /// The passivity controller reduced the force that limit() returned.
  void weakened_to(Vector<DeviceFrame> force_N) noexcept { force_N_ = force_N; }

  /// The motors hold no force now.
  void reset() noexcept { *this = {}; }

  /// Another part of the same spring, a torque, was limited after limit().
  void note_limited() noexcept { was_limited_ = true; }
  /// The share of the spring that is rendered now, 0 ... 1.
  double share() const noexcept { return share_; }
  double withheld_J() const noexcept { return withheld_J_; }

 private:
  /// The part of the depth over which the share changes.
  static constexpr double kFollowing = 0.05;

  void count(double unpaid_J) noexcept { withheld_J_ = std::max(0.0, withheld_J_ + unpaid_J); }

  void follow(const Input& in) noexcept {
    const double spring_N = norm(in.spring_N);
    const double out_m = (dot(in.spring_N, in.moved_m) + in.spring_turned_J) / spring_N;
    const double goal = out_m > 0.0 ? std::clamp(1.0 - withheld_J_ / in.stored_J, 0.0, share_) : 1.0;
    // A spring that stores U at a force f is compressed by 2 U / f.
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
