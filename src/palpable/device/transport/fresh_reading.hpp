// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <algorithm>
#include <cstdint>
#include <string>

namespace palpable::device {

/// The reading of a device whose positions come over a connection: it is stale, and the force zero, when no
/// plausible position has come for kStale_s; after kSilent_s the device has failed. After a silence it stays
/// stale for kRest_s more: until the force of the tick has ramped down too, so that it then rises from zero
/// and does not come back at once. Servo's thread only; no allocation but in silence_of().
class FreshReading {
 public:
  static constexpr double kStale_s = 0.007;
  static constexpr double kSilent_s = 0.5;
  /// Longer than a tick's ramp to zero (haptics::TickOptions::ramp_down_s).
  static constexpr double kRest_s = 0.025;

  /// `period_s`: of the servo's ticks; `stale_s`, `silent_s`: as above, for a slower connection. Not ready
  /// until renew().
  explicit FreshReading(double period_s, double stale_s = kStale_s, double silent_s = kSilent_s) noexcept
      : period_s_(period_s), stale_s_(stale_s), silent_s_(silent_s) {
    reading_.status = Status::not_ready;
  }

  /// The next tick begins, a period after the last one, or later if a clock says so.
  void pass(double by_clock_s = 0.0) noexcept {
    const double passed_s = std::max(period_s_, by_clock_s);
    age_s_ += passed_s;
    candidate_age_s_ += passed_s;
  }
  /// A position came. It is believed if a hand can have moved there since the last one; after one that was
  /// not believed, or a time without any, only as the third in a row of which this is true. False: not
  /// believed.
  bool renew_plausible(Vec3 position_m, std::uint32_t buttons, Status status) noexcept {
    const bool agrees = is_reachable(candidate_m_, position_m, candidate_age_s_);
    agreeing_ = agrees ? agreeing_ + 1 : 1;
    candidate_m_ = position_m;
    candidate_age_s_ = 0.0;
    const bool follows =
        !begun_ || (!doubted_ && age_s_ <= stale_s_ && is_reachable(reading_.position.v, position_m, age_s_));
    doubted_ = !follows && agreeing_ < kAgreeing;
    if (doubted_) return false;
    renew(position_m, buttons, status);
    return true;
  }
  /// A plausible position came, and with it this status.
  void renew(Vec3 position_m, std::uint32_t buttons, Status status) noexcept {
    reading_.position.v = position_m;
    reading_.buttons = buttons;
    last_ = status;
    age_s_ = 0.0;
    begun_ = true;
  }
  /// The driver has taken a force back by itself: stale for kRest_s.
  void rest() noexcept { rest_s_ = kRest_s; }
  /// Since the last position, or the beginning.
  double age_s() const noexcept { return age_s_; }
  const Reading& reading() const noexcept { return reading_; }

  /// The reading of this tick; `failed`: the device is known to have failed.
  const Reading& now(bool failed) noexcept {
    const bool is_stale = age_s_ > stale_s_;
    if (is_stale) rest();
    const bool rests = rest_s_ > 0.0 && last_ == Status::ok;
    if (!is_stale) rest_s_ -= period_s_;
    reading_.status = failed || age_s_ > silent_s_ ? Status::fault
                      : is_stale || rests          ? Status::stale
                                                   : last_;
    reading_.is_repeated = age_s_ > 0.0;
    return reading_;
  }
  /// The force that the device may make after this reading: none unless it is good.
  Vec3 allowed(Vec3 force_N) const noexcept { return reading_.status == Status::ok ? force_N : Vec3{}; }

  /// What a device has done that failed by its age, whether it is silent or sends what is no position.
  static std::string silence_of(const std::string& device) {
    return "the " + device + " gives no valid position any more";
  }

 private:
  static constexpr int kAgreeing = 3;
  static bool is_reachable(Vec3 from_m, Vec3 to_m, double within_s) noexcept {
    constexpr double kFastest_m_per_s = 3.0;
    constexpr double kLeast_m = 0.002;
    return norm(to_m - from_m) <= kLeast_m + kFastest_m_per_s * within_s;
  }

  double period_s_;
  double stale_s_;
  double silent_s_;
  double age_s_ = 0.0;
  double rest_s_ = 0.0;
  Reading reading_;
  Status last_ = Status::not_ready;
  bool begun_ = false;
  /// The newest position was not believed.
  bool doubted_ = false;
  /// The newest position, believed or not, its age, and how many in a row a hand can have gone through.
  Vec3 candidate_m_;
  double candidate_age_s_ = 0.0;
  int agreeing_ = 0;
};

}  // namespace palpable::device
