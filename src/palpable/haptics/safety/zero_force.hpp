// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"

namespace palpable::haptics {

/// Every servo of this process writes zero force and ends. For signal handlers, from any thread: allocates
/// and locks nothing. Waits until all have, at most `patience_ms`; true if so. On a servo's own thread (a
/// crash there) it stops that servo's device itself. Servos started later run.
bool end_every_servo(int patience_ms) noexcept;

/// From here on a crash of this program (a bad memory access, a failed assertion) writes zero force first and
/// then ends the program as it would have. Leaves handlers alone that somebody else has set.
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
