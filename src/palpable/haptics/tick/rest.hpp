// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/tick/servo_types.hpp"

namespace palpable::haptics {

/// Measures how long a probe has been at rest: its position, force, label, status and flags have not changed
/// since the tick in which the rest began. Tick path.
class RestDetector {
 public:
  /// Smaller differences count as no change: a filtered position approaches its target without ever reaching
  /// it.
  static constexpr double kMoved_m = 1e-7;
  static constexpr double kForce_N = 1e-4;

  /// Takes the sample of the newest tick, `dt_s` after the previous one.
  void update(const TouchSample& sample, double dt_s) noexcept;
  double rested_s() const noexcept { return rested_s_; }

 private:
  bool is_same(const TouchSample& sample) const noexcept;

  TouchSample began_;
  double rested_s_ = 0.0;
};

}  // namespace palpable::haptics
