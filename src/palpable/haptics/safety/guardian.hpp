// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"
#include "palpable/device/zero_write.hpp"
#include "palpable/haptics/safety/shared_beats.hpp"

#include <array>
#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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

  /// Returns when the guardian watches. Errors: failed, with the reason and the helper program, where it is
  /// missing, cannot be started, or is none: it ends, or does not answer within two seconds.
  static Result<std::unique_ptr<Guardian>> start(const device::ZeroWrite& zero);
  /// The guardian writes zero force and ends; the destructor waits for that. The device must still be open.
  ~Guardian();
  Guardian(const Guardian&) = delete;
  Guardian& operator=(const Guardian&) = delete;

  /// Called in each tick, after the force was written. From the first call on, stillness counts.
  void beat() noexcept { shared_->fetch_add(1, std::memory_order_relaxed); }

  /// Starts the process again if it has ended, for example killed because memory ran out. Errors: as start();
  /// then nothing guards the device. Any thread but that of beat(), one at a time.
  Result<void> keep_alive();

  pid_t process() const { return process_; }

 private:
  /// What the process is started with.
  struct Start {
    std::filesystem::path program;
    std::vector<std::string> arguments;
    /// The pipe's end to read, the device, and the shared memory.
    std::array<Descriptor, 3> descriptors;
  };
  Guardian(Descriptor alive, SharedBeats* shared, Start start)
      : alive_(std::move(alive)), shared_(shared), start_(std::move(start)) {}
  Result<void> start_process();
  Result<void> wait_until_ready(const Descriptor& answer);
  void end_process();

  Descriptor alive_;
  /// In memory that is shared with the guardian.
  SharedBeats* shared_;
  Start start_;
  /// -1: none.
  pid_t process_ = -1;
};

}  // namespace palpable::haptics
