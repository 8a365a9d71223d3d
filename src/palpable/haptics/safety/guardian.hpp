// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/device/zero_write.hpp"

#include <atomic>
#include <cstdint>
#include <memory>

#include <sys/types.h>

namespace palpable::haptics {

/// A separate process (`palpable-guardian`) that sets a device's force to zero if this program ends without
/// having done so, for example after SIGKILL, or if its servo stands still for kStill_ms, for example after
/// SIGSTOP. It writes the device's ZeroWrite, so it serves only devices that have one. It detects the end
/// through a pipe, and stillness through a counter in shared memory: the system closes a killed program's
/// pipes only after it has freed its memory, which takes tens of milliseconds.
class Guardian {
 public:
  /// The guardian looks every 3 ms.
  static constexpr int kStill_ms = 8;

  /// Errors: failed, with the reason, where the helper program is missing or cannot be started.
  static Result<std::unique_ptr<Guardian>> start(const device::ZeroWrite& zero);
  /// The guardian writes zero force and ends; the destructor waits for that. The device must still be open.
  ~Guardian();
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  /// Called in each tick, after the force was written. From the first call on, stillness counts.
  void beat() noexcept { beats_->fetch_add(1, std::memory_order_relaxed); }

  pid_t process() const { return process_; }

 private:
  using Beats = std::atomic<std::uint64_t>;
  Guardian(Descriptor alive, Beats* beats, pid_t process)
      : alive_(std::move(alive)), beats_(beats), process_(process) {}

  Descriptor alive_;
  /// In memory that is shared with the guardian.
  Beats* beats_;
  pid_t process_;
};

}  // namespace palpable::haptics
