// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

namespace palpable::haptics {

/// Every servo of this process writes zero force and ends. For signal handlers, from any thread: allocates
/// and locks nothing. Waits until all have, at most `patience_ms`; true if so. On a servo's own thread (a
/// crash there) it stops that servo's device itself. Servos started later run.
bool end_every_servo(int patience_ms) noexcept;

/// From here on every signal that would end this program (a bad memory access, a failed assertion, an
/// exception that nobody caught, SIGQUIT, a limit of processor time …) writes zero force first and then ends
/// it as it would have; and signals by which a terminal stops a program (Ctrl-Z) are ignored. Leaves handlers
/// alone that somebody else has set, so set your own before.
void write_zero_force_on_crash() noexcept;

/// While it lives, the calling thread serves `device`, end_every_servo() knows of it, and the signals by
/// which a person ends a program are handled by other threads.
class RunningServo {
 public:
  explicit RunningServo(device::Device& device) noexcept;
  ~RunningServo();
  RunningServo(const RunningServo&) = delete;
  RunningServo& operator=(const RunningServo&) = delete;

  /// end_every_servo() was called since this began. Tick path.
  bool must_end() const noexcept;

 private:
  unsigned begun_after_;
};

}  // namespace palpable::haptics
