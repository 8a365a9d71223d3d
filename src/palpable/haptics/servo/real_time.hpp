// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>
#include <string>

namespace palpable::haptics {

/// What the operating system granted.
struct RealTimeOutcome {
  /// "SCHED_FIFO 80", or why not: "ordinary (Operation not permitted)".
  std::string priority;
  /// "locked", or why not.
  std::string memory;
};

/// Asks for SCHED_FIFO at `priority` (0 = do not ask) for the calling thread, and for wake-ups without slack.
/// The answer for RealTimeOutcome::priority.
std::string request_priority(int priority);

/// Keeps the process's pages in memory, those touched later too, where the limit allows it without risk to
/// later allocations. The answer for RealTimeOutcome::memory.
std::string lock_memory();

/// Numbers below 1e-308 become 0 on the calling thread: they cost a hundred times more and mean nothing here.
void flush_denormals() noexcept;

/// The servo's arithmetic (flush_denormals) while it lives, on the calling thread; then what was before.
class ServoArithmetic {
 public:
  ServoArithmetic() noexcept {
    std::fegetenv(&before_);
    flush_denormals();
  }
  ~ServoArithmetic() { std::fesetenv(&before_); }
  ServoArithmetic(const ServoArithmetic&) = delete;
  ServoArithmetic& operator=(const ServoArithmetic&) = delete;

 private:
  std::fenv_t before_{};
};

/// Touches the calling thread's next 64 kB of stack, so that the loop does not meet a page fault there.
void touch_stack() noexcept;

}  // namespace palpable::haptics
