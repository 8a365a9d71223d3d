// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/child_process.hpp"
#include "palpable/core/result.hpp"
#include "palpable/device/zero_write.hpp"

#include <memory>

#include <sys/types.h>

namespace palpable::haptics {

/// A separate process (`palpable-guardian`) that sets a device's force to zero if this program ends without
/// having done so, for example after SIGKILL. It detects the end through a pipe and writes the device's
/// ZeroWrite, so it serves only devices that have one. A stopped program (SIGSTOP) has not ended: in that
/// case only a watchdog inside the device helps.
class Guardian {
 public:
  /// Errors: failed, with the reason, where the helper program is missing or cannot be started.
  static Result<std::unique_ptr<Guardian>> start(const device::ZeroWrite& zero);
  /// The guardian writes zero force and ends; the destructor waits for that. The device must still be open.
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
