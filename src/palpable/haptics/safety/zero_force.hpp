// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

namespace palpable::haptics {

/// Makes every servo loop of this process write zero force and end. Callable from signal handlers and from
/// any thread: it neither allocates nor locks. It waits until all have ended, for at most `patience_ms`; true
/// if they have. Called on a servo's own thread (a crash there), it cuts that servo's device itself. Servo
/// loops that start later run normally.
bool end_every_servo(int patience_ms) noexcept;

/// Installs handlers for every signal that would end this program (a bad memory access, a failed assertion,
/// an uncaught exception, SIGQUIT, a limit of processor time ...). They write zero force and then let the
/// signal end the program as usual. Signals by which a terminal stops a program (Ctrl-Z) are ignored from now
/// on. Handlers that are already installed are kept: install your own before this call.
void write_zero_force_on_crash() noexcept;

/// Scope guard of a servo thread. While it exists, the calling thread serves `device`, end_every_servo()
/// reaches it, and the signals by which a user ends a program are handled by other threads. `device` must
/// outlive it.
class RunningServo {
 public:
  explicit RunningServo(device::Device& device) noexcept;
  ~RunningServo();
  RunningServo(const RunningServo&) = delete;
  RunningServo& operator=(const RunningServo&) = delete;

  /// Whether end_every_servo() was called since construction. Tick path.
  bool must_end() const noexcept;

 private:
  unsigned begun_after_;
};

}  // namespace palpable::haptics
