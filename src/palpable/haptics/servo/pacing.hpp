// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/haptics/servo/servo_types.hpp"

#include <cstdint>

namespace palpable::haptics {

/// CLOCK_MONOTONIC in nanoseconds.
std::int64_t monotonic_ns() noexcept;

/// Wakes a loop at begin + k·period for k = 1, 2, …, computed from the begin each time: it never drifts.
/// After a stall the deadlines that passed are skipped, and the next one is waited for in full. Each wait
/// sleeps to shortly before the deadline and watches the clock from there, because sleeping alone wakes tens
/// of microseconds late (docs/measurements.md). One thread; no allocation or lock.
class Pacer {
 public:
  /// `watch_s` is how long before a deadline the sleep ends; 0 = sleep to the deadline.
  Pacer(double rate_hz, double watch_s);

  struct Wake {
    std::int64_t now_ns = 0;
    /// Periods since the wake before: 1, or 1 + the deadlines missed.
    std::uint32_t periods = 1;
    /// After the deadline that this wake was meant for.
    double late_us = 0.0;
    /// Meaningful if deadlines were missed.
    MissedDeadline::Cause cause = MissedDeadline::Cause::late_wake;
  };

  /// Counting begins here; the first deadline is one period from now.
  void begin() noexcept;
  Wake wait() noexcept;
  /// Sleeps for so long instead, and counts the deadlines from the wake on: none was missed.
  Wake rest(double seconds) noexcept;
  std::int64_t deadline_ns(std::int64_t k) const noexcept;

 private:
  double period_ns_;
  std::int64_t watch_ns_;
  std::int64_t begin_ns_ = 0;
  std::int64_t last_ = 0;
  std::int64_t woke_ns_ = 0;
  std::int64_t woke_cpu_ns_ = 0;
};

}  // namespace palpable::haptics
