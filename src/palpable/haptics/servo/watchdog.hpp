// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace palpable::haptics {

/// Writes zero force when the servo's thread does not: a thread of its own, which watches when that thread
/// last wrote. If a write is overdue by kPatience_s, it cuts the device's force, at most kPoll_s later, and
/// again only after another write. So a loop that hangs, in a driver or in a law, leaves the motors without
/// force within 5 ms of the write that was due.
class Watchdog {
 public:
  static constexpr double kPatience_s = 0.003;
  static constexpr double kPoll_s = 0.0005;

  /// `device` outlives this. `period_s` > 0: the servo's. The thread asks for `priority` as
  /// request_priority() does. Nothing is watched before the first write.
  Watchdog(device::Device& device, double period_s, int priority);
  ~Watchdog();
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// The servo's thread: it has written at `now_ns` (monotonic). Tick path.
  void note_write(std::int64_t now_ns) noexcept { wrote_ns_.store(now_ns, std::memory_order_release); }
  /// The servo's thread: true once after each cut. Tick path.
  bool take_cut() noexcept {
    return cut_.load(std::memory_order_relaxed) && cut_.exchange(false, std::memory_order_acq_rel);
  }
  /// From here on nothing is watched: the servo ends.
  void stop() noexcept { wrote_ns_.store(0, std::memory_order_release); }

 private:
  void watch(int priority) noexcept;

  device::Device& device_;
  std::int64_t allowed_ns_;
  /// 0: nothing is watched.
  std::atomic<std::int64_t> wrote_ns_{0};
  std::atomic<bool> cut_{false};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace palpable::haptics
