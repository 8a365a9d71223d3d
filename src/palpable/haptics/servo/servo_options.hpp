// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/thread_priority.hpp"
#include "palpable/haptics/tick/tick_options.hpp"

#include <cstddef>
#include <cstdint>

namespace palpable::haptics {

enum class Memory { leave, lock };
enum class Recording { off, on };

struct ServoOptions {
  /// 100 to 4000.
  double rate_hz = 1000.0;
  TickOptions tick;
  /// Requested SCHED_FIFO priority, 1 to 99; 0 = none.
  int realtime_priority = kForcePriority;
  /// Whether the whole process's pages are locked in memory.
  Memory memory = Memory::lock;
  /// Time before a deadline in which the thread polls the clock, at most half a period; 0 = sleep until the
  /// deadline. A device without motors always sleeps until the deadline, and has no watchdog.
  double watch_s = 150e-6;
  /// For a device that may rest (device::Traits::may_rest). After this time without a change of any probe
  /// (RestDetector), the loop ticks once per rest_period_s until something changes; dt remains the period of
  /// the loop's rate. The loop never rests while it records. Infinity = never.
  double rest_after_s = 1.0;
  /// Seconds, 0.001 to 0.1.
  double rest_period_s = 0.02;
  /// Samples buffered for a recorder that is late, at least 1: 4 s at 4 kHz.
  std::size_t recording_capacity = 16384;
  /// On from the first tick, or later by record().
  Recording recording = Recording::off;
  /// Only for a simulated device: a tick's time is its number divided by the rate, however late it came, and
  /// no watchdog takes the force away, so that the same device gives the same session again.
  bool time_by_ticks = false;
  /// After so many ticks the loop ends, with zero force, as by stop(); 0 = never.
  std::uint64_t most_ticks = 0;
};

/// The tick's options for a loop with this rate: the fields that depend on the rate are set.
TickOptions tick_options(const ServoOptions& options);

/// Sets all times that depend on the loop's rate.
ServoOptions for_rate(ServoOptions options);

/// Errors: usage for a value out of range.
Result<void> check(const ServoOptions& options);

}  // namespace palpable::haptics
