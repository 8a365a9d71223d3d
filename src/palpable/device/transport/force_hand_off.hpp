// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/system/hand_off.hpp"
#include "palpable/core/vec3.hpp"

#include <atomic>
#include <chrono>
#include <cstdint>
#include <thread>
#include <utility>

namespace palpable::device {

/// Passes commands (forces, or surfaces that make forces) from the servo's thread to the thread of a driver
/// that exchanges them with its device. A command that is older than `longest_s`, or was put before a cut, is
/// not used any more: a hanging servo never holds a force. A default Command makes no force. A force that was
/// taken back in this way, or because the driver's thread had to, does not come back at once: there is no
/// command until the servo has noticed it, and begins from zero. Neither side waits, locks or allocates,
/// except wait_for_zero().
template <class Command>
class CommandHandOff {
 public:
  static constexpr double kUnwritten_s = 0.005;

  explicit CommandHandOff(double longest_s = kUnwritten_s) noexcept
      : longest_s_(longest_s), since_put_s_(longest_s) {}

  struct Taken {
    /// The default if there is no valid one.
    Command command{};
    bool valid = false;
    std::uint32_t cuts = 0;
  };

  /// The servo's thread.
  void put(const Command& command) noexcept {
    commands_.put({command, cuts_.load(std::memory_order_acquire), noticed_});
  }

  /// The servo's thread: true once after a force was taken back. The servo's next commands must begin from
  /// zero.
  bool notice_taken_back() noexcept {
    return std::exchange(noticed_, taken_back_.load(std::memory_order_acquire)) != noticed_;
  }

  /// Any thread: from the next take() on there is no command until the next put().
  void cut() noexcept { cuts_.fetch_add(1, std::memory_order_acq_rel); }

  /// The driver's thread: the command to send, `elapsed_s` after the last call; none unless it `may_push`.
  Taken take(double elapsed_s, bool may_push = true) noexcept {
    since_put_s_ = commands_.take(last_) ? 0.0 : since_put_s_ + elapsed_s;
    const std::uint32_t cuts = cuts_.load(std::memory_order_acquire);
    const std::uint32_t taken_back = taken_back_.load(std::memory_order_relaxed);
    const bool is_cut = last_.cuts != cuts;
    if (may_push && since_put_s_ < longest_s_ && !is_cut && last_.noticed == taken_back) {
      pushes_ = last_.command != Command{};
      return {last_.command, true, cuts};
    }
    // Who cut it knows that.
    if (std::exchange(pushes_, false) && !is_cut)
      taken_back_.store(taken_back + 1, std::memory_order_release);
    since_put_s_ = longest_s_;
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
  double longest_s_;
  struct Put {
    Command command{};
    std::uint32_t cuts = 0;
    /// How many forces that were taken back the servo had noticed.
    std::uint32_t noticed = 0;
  };
  LatestValue<Put> commands_;
  std::atomic<std::uint32_t> cuts_{0};
  std::atomic<std::uint32_t> zero_after_cuts_{0};
  std::atomic<std::uint32_t> taken_back_{0};
  // The servo's thread only.
  std::uint32_t noticed_ = 0;
  // The driver's thread only.
  Put last_;
  double since_put_s_;
  /// The last command that was taken was a force.
  bool pushes_ = false;
};

using ForceHandOff = CommandHandOff<Vec3>;

}  // namespace palpable::device
