// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cfenv>
#include <string>

namespace palpable::haptics {

/// What the operating system granted.
struct RealTimeOutcome {
  /// See request_priority().
  std::string priority;
  /// "locked", or the reason why not.
  std::string memory;
};

/// Locks the process's present and future pages in memory, if the limit is high enough that later allocations
/// cannot fail because of it. Returns the text for RealTimeOutcome::memory.
std::string lock_memory();

/// Makes the calling thread treat denormal numbers (below 1e-308) as 0. They take about a hundred times
/// longer and are irrelevant here.
void flush_denormals() noexcept;

/// Scope guard: the calling thread uses the servo's arithmetic (flush_denormals) while it exists; the
/// destructor restores the previous floating-point environment.
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
