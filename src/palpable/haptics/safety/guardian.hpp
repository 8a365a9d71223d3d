// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/child_process.hpp"
#include "palpable/core/result.hpp"
#include "palpable/device/zero_write.hpp"

#include <memory>

#include <sys/types.h>

namespace palpable::haptics {

/// A process of its own (`palpable-guardian`) that takes the force from a device when this program ends
/// without having done so, as after SIGKILL: it sees the end at a pipe and writes the device's ZeroWrite. For
/// devices that have one. A stopped program (SIGSTOP) has not ended; against that only the device helps.
class Guardian {
 public:
  /// Errors: failed, with the reason, where the helper program is missing or cannot be started.
  static Result<std::unique_ptr<Guardian>> start(const device::ZeroWrite& zero);
  /// The guardian writes and ends; waits for that. The device must still be open.
  ~Guardian();
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  pid_t process() const { return process_; }

 private:
  Guardian(Descriptor alive, pid_t process) : alive_(std::move(alive)), process_(process) {}

  Descriptor alive_;
  pid_t process_;
};

}  // namespace palpable::haptics
