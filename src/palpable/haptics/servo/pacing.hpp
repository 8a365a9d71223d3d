// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/tick/servo_types.hpp"

#include <cstdint>

namespace palpable::haptics {

/// CLOCK_MONOTONIC in nanoseconds.
std::int64_t monotonic_ns() noexcept;

/// Wakes a loop at start + k·period for k = 1, 2, ... Each deadline is computed from the start, so the loop
/// does not drift. After a stall the deadlines that passed are skipped, and the loop waits for the next one
/// in full. Each wait sleeps until shortly before the deadline and then polls the clock, because sleeping
/// alone wakes tens of microseconds late (docs/measurements.md). One thread; no allocation or lock.
class Pacer {
 public:
  /// `rate_hz` > 0. `watch_s` >= 0 is the time before a deadline at which sleeping ends and polling begins; 0
  /// = sleep until the deadline.
  Pacer(double rate_hz, double watch_s);

  struct Wake {
    std::int64_t now_ns = 0;
    /// Periods since the previous wake: 1 + the number of missed deadlines.
    std::uint32_t periods = 1;
    /// Delay after the deadline for which this wake was meant.
    double late_us = 0.0;
    /// Valid only if deadlines were missed.
    MissedDeadline::Cause cause = MissedDeadline::Cause::late_wake;
  };

  /// Starts counting; the first deadline is one period from now.
  void begin() noexcept;
  /// Sleeps until polling begins. True if then there is time for work of a few microseconds before the
  /// deadline, which is not counted as late. Followed by wait().
  bool sleep() noexcept;
  /// Waits for the next deadline.
  Wake wait() noexcept;
  /// Sleeps for `seconds` instead and restarts the deadlines at the wake: none counts as missed.
  Wake rest(double seconds) noexcept;
  /// Time of deadline k on the monotonic clock.
  std::int64_t deadline_ns(std::int64_t k) const noexcept;

 private:
  double period_ns_;
  std::int64_t watch_ns_;
  std::int64_t begin_ns_ = 0;
  std::int64_t last_ = 0;
  /// What sleep() found, until wait() returns it.
  Wake coming_;
  bool slept_ = false;
  bool polls_ = false;
  std::int64_t woke_ns_ = 0;
  std::int64_t woke_cpu_ns_ = 0;
};

}  // namespace palpable::haptics
