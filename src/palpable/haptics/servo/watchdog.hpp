// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace palpable::haptics {

/// Decides when a write is overdue. The caller supplies the time.
class OverdueWrite {
 public:
  /// `period_s` > 0 is the servo's period; `patience_s` is the time allowed beyond it.
  OverdueWrite(double period_s, double patience_s) noexcept
      : allowed_ns_(static_cast<std::int64_t>(1e9 * (period_s + patience_s))) {}

  /// Whether the force must be cut at `now_ns`, if the last write was at `wrote_ns` (0: nothing is watched).
  /// True only once after each write.
  bool must_cut(std::int64_t wrote_ns, std::int64_t now_ns) noexcept {
    if (wrote_ns == 0 || wrote_ns == cut_after_ns_ || now_ns - wrote_ns <= allowed_ns_) return false;
    cut_after_ns_ = wrote_ns;
    return true;
  }

 private:
  std::int64_t allowed_ns_;
  std::int64_t cut_after_ns_ = 0;
};

/// Writes zero force if the servo thread does not write. It runs on a separate thread and checks the time of
/// the servo's last write. If a write is overdue by kPatience_s, it cuts the device's force, at most kPoll_s
/// later, and only once until the next write. So a loop that hangs in a driver or a law leaves the motors
/// without force within 5 ms of the missed write.
class Watchdog {
 public:
  static constexpr double kPatience_s = 0.003;
  static constexpr double kPoll_s = 0.0005;

  /// `device` must outlive this object. `period_s` > 0 is the servo's period. The thread requests `priority`
  /// as request_priority() does. Nothing is watched before the first write.
  Watchdog(device::Device& device, double period_s, int priority);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Called by the servo thread: it wrote at `now_ns` (monotonic). Tick path.
  void note_write(std::int64_t now_ns) noexcept { wrote_ns_.store(now_ns, std::memory_order_release); }
  /// Called by the servo thread: true once after each cut. Tick path.
  bool take_cut() noexcept {
    return cut_.load(std::memory_order_relaxed) && cut_.exchange(false, std::memory_order_acq_rel);
  }
  /// The same flag, for TickPipeline::watch_cuts().
  std::atomic<bool>& cut_flag() noexcept { return cut_; }
  /// Stops watching, because the servo ends.
  void stop() noexcept { wrote_ns_.store(0, std::memory_order_release); }

 private:
  void watch(int priority) noexcept;

  device::Device& device_;
  OverdueWrite overdue_;
  /// 0: nothing is watched.
  std::atomic<std::int64_t> wrote_ns_{0};
  std::atomic<bool> cut_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

/// Time from a hanging loop's last write to the cut of its force, in milliseconds.
struct WatchdogLatency {
  int hangs = 0;
  double p50_ms = 0.0;
  double p99_ms = 0.0;
  double max_ms = 0.0;
};

/// Simulates a loop that writes at `rate_hz` and hangs `hangs` times (> 0), on a device that only records
/// when its force is cut.
WatchdogLatency measure_watchdog(double rate_hz, int hangs, int priority);

}  // namespace palpable::haptics
