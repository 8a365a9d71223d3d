// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

namespace palpable::haptics {

/// The time of a tick, and whether the force before it is unknown: another thread cut it, or it is not known
/// how long it acted.
struct TickTime {
  /// Since the first tick, and since the previous one.
  double t_s = 0.0;
  double dt_s = 0.001;
  bool stalled = false;
};

/// The shortest and the longest time between two ticks that are computed with. No loop is as fast as the
/// first (ServoOptions::rate_hz), and no touch lasts as long as the second.
inline constexpr double kShortestStep_s = 1e-6;
inline constexpr double kLongestStep_s = 1e6;

/// `when`, if it is a time. Otherwise (a clock or a recording states a time that is not finite, or a step
/// that is not between the two above) what is computed with instead: a step of a millisecond after a stall,
/// so that the force begins from zero. This is the one place that decides about it: behind it every step of a
/// tick is finite and above 0, and times increase. `before_s` is the time of the previous tick. Tick path.
inline TickTime usable_time(TickTime when, double before_s) noexcept {
  constexpr double kAssumedStep_s = 0.001;
  if (!(when.dt_s >= kShortestStep_s && when.dt_s <= kLongestStep_s)) {
    when.dt_s = kAssumedStep_s;
    when.stalled = true;
  }
  if (!(when.t_s > before_s && std::isfinite(when.t_s))) when.t_s = before_s + when.dt_s;
  return when;
}

}  // namespace palpable::haptics
