// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/core/vec3.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>

namespace palpable::device {

/// Passes forces from the servo's thread to the thread of a driver that exchanges them with its device. A
/// force that is older than kUnwritten_s, or was put before a cut, is not used any more: a hanging servo
/// never holds a force. Neither side waits, locks or allocates, except wait_for_zero().
class ForceHandOff {
 public:
  static constexpr double kUnwritten_s = 0.005;

  struct Taken {
    /// Zero if there is no valid force.
    Vec3 force_N;
    bool valid = false;
    std::uint32_t cuts = 0;
  };

  /// The servo's thread.
  void put(Vec3 force_N) noexcept { commands_.put({force_N, cuts_.load(std::memory_order_acquire)}); }

  /// Any thread: from the next take() on there is no force until the next put().
  void cut() noexcept { cuts_.fetch_add(1, std::memory_order_acq_rel); }

  /// The driver's thread: the force to send, `elapsed_s` after the last call.
  Taken take(double elapsed_s) noexcept {
    since_put_s_ = commands_.take(command_) ? 0.0 : since_put_s_ + elapsed_s;
    const std::uint32_t cuts = cuts_.load(std::memory_order_acquire);
    if (since_put_s_ < kUnwritten_s && command_.cuts == cuts) return {command_.force_N, true, cuts};
    since_put_s_ = kUnwritten_s;
    return {{}, false, cuts};
  }

  /// The driver's thread: `taken` has been sent.
  void sent(const Taken& taken) noexcept {
    if (!taken.valid) zero_after_cuts_.store(taken.cuts, std::memory_order_release);
  }

  /// Waits until zero was sent after the last cut(), at most this long. Not for the tick path.
  void wait_for_zero(std::chrono::milliseconds longest) const {
    const auto until = std::chrono::steady_clock::now() + longest;
    while (zero_after_cuts_.load(std::memory_order_acquire) != cuts_.load(std::memory_order_acquire) &&
           std::chrono::steady_clock::now() < until)
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

 private:
  struct Command {
    Vec3 force_N;
    std::uint32_t cuts = 0;
  };
  LatestValue<Command> commands_;
  std::atomic<std::uint32_t> cuts_{0};
  std::atomic<std::uint32_t> zero_after_cuts_{0};
  // The driver's thread only.
  Command command_;
  double since_put_s_ = kUnwritten_s;
};

}  // namespace palpable::device
