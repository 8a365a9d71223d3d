// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/watchdog.hpp"

#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/real_time.hpp"

#include <chrono>

namespace palpable::haptics {

Watchdog::Watchdog(device::Device& device, double period_s, int priority)
    : device_(device),
      allowed_ns_(static_cast<std::int64_t>(1e9 * (period_s + kPatience_s))),
      thread_([this, priority] { watch(priority); }) {}

Watchdog::~Watchdog() {
  ending_.store(true, std::memory_order_release);
  thread_.join();
}

void Watchdog::watch(int priority) noexcept {
  static_cast<void>(request_priority(priority));
  std::int64_t cut_after_ns = 0;
  while (!ending_.load(std::memory_order_acquire)) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kPoll_s));
    const std::int64_t wrote_ns = wrote_ns_.load(std::memory_order_acquire);
    if (wrote_ns == 0 || wrote_ns == cut_after_ns || monotonic_ns() - wrote_ns <= allowed_ns_) continue;
    cut_after_ns = wrote_ns;
    device_.cut_force();
    cut_.store(true, std::memory_order_release);
  }
}

}  // namespace palpable::haptics
