// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/safety/limits.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

/// Lets a force grow only so fast (cap_rise) and brings it up and down under a ramp, without making energy.
/// Where a spring stores U but its force was held back (by the limit, a ramp, a dropped force), the hand has
/// given only P of it: what it gave in this contact, the time before a dropped force included, less what came
/// back. A hand at rest meets the whole spring nevertheless. One that moves out meets, after a twentieth of
/// the depth, a spring that begins further in: the potential
///     V = (sqrt(U) - c)^2 = P, and the share dV/dU = 1 - c/sqrt(U) of the law's force,
/// which is as stiff as the law's own, gives back P and no more, and is conservative itself. c shrinks as the
/// hand leaves, so that nothing is left of it outside. Damping and friction, which are not the spring's, stay
/// whole. A tick is account(), then limit(). Tick path; no allocation.
class RiseLimit {
 public:
  struct Input {
    /// What the law's spring stores now, and its force, after the cap; NaN where the law has no spring: then
    /// the force follows the ramp, and nothing is counted.
    double stored_J = 0.0;
    Vector<DeviceFrame> spring_N;
    /// What a change of scene added to stored_J since the last call.
    double changed_J = 0.0;
    /// What the hand received since the last call, of force and torque, J; how far it moved in the sense of
    /// the spring's force, m; and the ticks until a force acts.
    double received_J = 0.0;
    double moved_out_m = 0.0;
    double delay_ticks = 0.0;
    /// The ramp, 0 ... 1, and by how much it may rise in this tick.
    double gain = 1.0;
    double gain_rise = 1.0;
  };

  /// The movement since the last call.
  void account(const Input& in) noexcept {
    const double given_before_J = given_J();
    gain_ = in.gain;
    has_spring_ = in.stored_J > 0.0 && norm(in.spring_N) > 0.0;
    spring_N_ = in.spring_N;
    stored_J_ = has_spring_ ? in.stored_J : 0.0;
    root_ = std::sqrt(stored_J_);
    if (!has_spring_) {
      begins_ = false;
      lent_ = offset_ = rendered_J_ = spare_J_ = given_J_ = 0.0;
      return;
    }
    given_J_ = std::clamp(given_before_J - in.received_J, 0.0, stored_J_);
    // What the hand got while the force was on its way to zero is gone, and it gave nothing.
    if (begins_) lend(std::min(given_before_J, given_J_));
    begins_ = false;
    if (lent_ > 0.0) {
      take_back(in);
      return;
    }
    // The surface of another scene that comes up under a hand begins where the hand is.
    if (offset_ > 0.0)
      offset_ = std::max(0.0, offset_ + root_ - std::sqrt(std::max(0.0, stored_J_ - in.changed_J)));
    begin_at(offset_);
    follow_ramp(in.gain_rise);
  }

  /// The force of this tick, of the one that the law wants after the cap; `rest_N` of it is not the spring's.
  Limited<DeviceFrame> limit(Vector<DeviceFrame> law_N, Vector<DeviceFrame> rest_N,
                             double max_rise_N) noexcept {
    const Vector<DeviceFrame> wanted_N = rendered(law_N, rest_N);
    Limited<DeviceFrame> risen = cap_rise(wanted_N, force_N_, max_rise_N);
    if (risen.limited) note_limited();
    force_N_ = risen.force_N;
    return risen;
  }

  /// The passivity controller reduced the force that limit() returned.
  void weakened_to(Vector<DeviceFrame> force_N) noexcept { force_N_ = force_N; }

  /// The spring was held back: its force by limit(), or another part of it, a torque, after it.
  void note_limited() noexcept {
    if (has_spring_) lend(lent_ > 0.0 ? given_J_ : std::min(given_J_, given_J()));
  }

  /// The motors hold nothing any more, in the same touch; and in a new one, of which nothing is known.
  void drop() noexcept {
    lend(given_J());
    force_N_ = {};
    begins_ = true;
  }
  void reset() noexcept { *this = {}; }

  /// The part of the law's spring that is rendered now; the ramp where there is none.
  double share() const noexcept {
    if (!has_spring_) return gain_;
    return offset_ > 0.0 ? 1.0 - offset_ / root_ : 1.0;
  }
  /// The spring gives back less than it stores.
  bool is_weaker() const noexcept { return has_spring_ && (lent_ > 0.0 || offset_ > 0.0); }
  double withheld_J() const noexcept { return std::max(0.0, stored_J_ - given_J()); }
  /// What the hand gave and may get back, P.
  double given_J() const noexcept { return lent_ > 0.0 ? given_J_ : rendered_J_ + spare_J_; }

 private:
  /// The part of the depth over which what a hand at rest did not give is taken back.
  static constexpr double kTakenBack = 0.05;

  void lend(double given_J) noexcept {
    given_J_ = given_J;
    lent_ = 1.0;
  }

  void take_back(const Input& in) noexcept {
    const double goal = root_ * (1.0 - gain_);
    // A spring that stores U at a force f is 2 U / f deep.
    const double over_m = kTakenBack * 2.0 * stored_J_ / norm(spring_N_);
    lent_ = std::max(0.0, lent_ - std::max(0.0, in.moved_out_m) / over_m);
    // Stronger forces than the next ones are still on their way to the motors.
    const double coming_J = in.delay_ticks * std::max(0.0, in.received_J);
    if (in.moved_out_m > 0.0 && given_J_ <= coming_J + std::max(0.0, in.received_J)) lent_ = 0.0;
    if (gain_ >= 1.0 && given_J_ >= stored_J_) lent_ = 0.0;
    if (lent_ > 0.0) {
      const double paid = std::max(goal, root_ - std::sqrt(given_J_));
      begin_at(goal + (1.0 - lent_) * (paid - goal));
      return;
    }
    given_J_ = std::max(0.0, given_J_ - coming_J);
    begin_at(std::max(goal, root_ - std::sqrt(given_J_)));
    spare_J_ = std::max(0.0, given_J_ - rendered_J_);
  }

  void begin_at(double offset) noexcept {
    offset_ = std::min(offset, root_);
    const double over = root_ - offset_;
    rendered_J_ = offset_ > 0.0 ? over * over : stored_J_;
  }

  void follow_ramp(double gain_rise) noexcept {
    const double goal = root_ * (1.0 - gain_);
    const double before_J = rendered_J_;
    if (offset_ < goal) {
      begin_at(goal);
    } else if (spare_J_ > 0.0 && offset_ > 0.0) {
      begin_at(std::max({goal, offset_ - gain_rise * root_, root_ - std::sqrt(rendered_J_ + spare_J_)}));
    }
    spare_J_ = std::clamp(spare_J_ + before_J - rendered_J_, 0.0, stored_J_ - rendered_J_);
  }

  Vector<DeviceFrame> rendered(Vector<DeviceFrame> law_N, Vector<DeviceFrame> rest_N) const noexcept {
    const double part = share();
    if (!has_spring_ || gain_ <= 0.0) return gain_ * law_N;
    if (part >= 1.0) return law_N;
    const Vector<DeviceFrame> force_N = part * spring_N_ + rest_N;
    // No damper pulls.
    if (dot(force_N, spring_N_) <= 0.0) return {};
    return cap_force(force_N, norm(law_N)).force_N;
  }

  Vector<DeviceFrame> force_N_;
  Vector<DeviceFrame> spring_N_;
  double gain_ = 0.0;
  bool has_spring_ = false;
  bool begins_ = true;
  /// U and its root, c, V, and what the hand gave beyond it, B, while a ramp is below.
  double stored_J_ = 0.0;
  double root_ = 0.0;
  double offset_ = 0.0;
  double rendered_J_ = 0.0;
  double spare_J_ = 0.0;
  /// P and the part of what the hand did not give that is rendered nevertheless; 0: P = V + B.
  double given_J_ = 0.0;
  double lent_ = 0.0;
};

}  // namespace palpable::haptics
