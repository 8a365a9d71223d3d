// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

namespace palpable::device {

/// How long ago a device last gave a position, and what that makes of its readings. Servo's thread only; no
/// allocation.
class Freshness {
 public:
  /// Without a position for this long it is stale, and the force zero; later the device has failed.
  static constexpr double kStale_s = 0.008;
  static constexpr double kSilent_s = 0.5;

  explicit Freshness(double period_s) noexcept : period_s_(period_s) {}

  /// The next tick begins.
  void pass() noexcept { age_s_ += period_s_; }
  /// A plausible position came.
  void renew() noexcept { age_s_ = 0.0; }
  double age_s() const noexcept { return age_s_; }

  /// The status of a reading whose last position came with `last`: that, or stale or fault by its age.
  Status status(Status last) const noexcept {
    if (age_s_ > kSilent_s) return Status::fault;
    return age_s_ > kStale_s ? Status::stale : last;
  }

 private:
  double period_s_;
  double age_s_ = 0.0;
};

}  // namespace palpable::device
