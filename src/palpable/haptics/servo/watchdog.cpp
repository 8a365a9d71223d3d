// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/watchdog.hpp"

#include "palpable/core/numbers/quantile.hpp"
#include "palpable/core/system/thread_priority.hpp"
#include "palpable/haptics/servo/pacing.hpp"

#include <chrono>
#include <vector>

namespace palpable::haptics {
namespace {

/// Records when its force was cut, and wakes the waiting thread.
class CutClock final : public device::Device {
 public:
  const device::Traits& traits() const noexcept override { return traits_; }
  device::Reading read() noexcept override { return {}; }
  void write(Vector<DeviceFrame> /*force_N*/) noexcept override {}
  void stop() noexcept override {}
  void cut_force() noexcept override {
    cut_ns_.store(monotonic_ns(), std::memory_order_release);
    cut_ns_.notify_all();
  }
  /// Waits for a cut that happens after the previous call; returns its time.
  std::int64_t wait_for_cut() noexcept {
    cut_ns_.wait(0, std::memory_order_acquire);
    return cut_ns_.exchange(0, std::memory_order_acq_rel);
  }

 private:
  device::Traits traits_;
  std::atomic<std::int64_t> cut_ns_{0};
};

}  // namespace

WatchdogLatency measure_watchdog(double rate_hz, int hangs, int priority) {
  constexpr int kWritesBetween = 5;
  const double period_s = 1.0 / rate_hz;
  CutClock device;
  Watchdog watchdog(device, period_s, priority);
  std::vector<double> latencies_ms;
  for (int k = 0; k < hangs; ++k) {
    for (int n = 0; n < kWritesBetween; ++n) {
      watchdog.note_write(monotonic_ns());
      std::this_thread::sleep_for(std::chrono::duration<double>(period_s));
    }
    const std::int64_t wrote_ns = monotonic_ns();
    // If this thread itself was delayed, the force was cut already; that is not what is measured.
    if (watchdog.take_cut()) device.wait_for_cut();
    watchdog.note_write(wrote_ns);
    latencies_ms.push_back(1e-6 * static_cast<double>(device.wait_for_cut() - wrote_ns));
    watchdog.take_cut();
  }
  return {hangs, quantile_of(latencies_ms, 0.5), quantile_of(latencies_ms, 0.99),
          quantile_of(latencies_ms, 1.0)};
}

Watchdog::Watchdog(device::Device& device, double period_s, int priority)
    : device_(device), overdue_(period_s, kPatience_s), thread_([this, priority] { watch(priority); }) {}

Watchdog::~Watchdog() {
  ending_.store(true, std::memory_order_release);
  thread_.join();
}

void Watchdog::watch(int priority) noexcept {
  static_cast<void>(request_priority(priority));
  while (!ending_.load(std::memory_order_acquire)) {
    std::this_thread::sleep_for(std::chrono::duration<double>(kPoll_s));
    if (!overdue_.must_cut(wrote_ns_.load(std::memory_order_acquire), monotonic_ns())) continue;
    device_.cut_force();
    cut_.store(true, std::memory_order_release);
  }
}

}  // namespace palpable::haptics
