// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/system/child_process.hpp"

#include <atomic>
#include <cstddef>
#include <memory>
#include <span>
#include <string>

struct termios;

namespace palpable::device {

/// A serial port in raw mode (8 data bits, no flow control) that only this program uses. Neither read() nor
/// write() waits, allocates, locks or throws. When it is closed, its settings are those of before, and
/// its modem lines are left as they are.
class SerialPort {
 public:
  /// Errors (device): not there, permission denied (with the group that has it), used by another program, not
  /// a serial port.
  static Result<std::unique_ptr<SerialPort>> open(const std::string& path);

  ~SerialPort();
  SerialPort(const SerialPort&) = delete;
  SerialPort& operator=(const SerialPort&) = delete;

  /// Copies bytes that have arrived to the start of `bytes` and returns their number; 0 if none has.
  std::size_t read(std::span<std::byte> bytes) noexcept;
  /// Sends all bytes or, if the system's buffer is full or the port is lost, returns false. Up to 4096 bytes
  /// are one unit: those of two threads are not mixed.
  bool write(std::span<const std::byte> bytes) noexcept;
  /// Drops the bytes that have arrived and were not read.
  void drop_input() noexcept;
  /// Drops the bytes that the system has not yet sent.
  void drop_output() noexcept;
  /// Waits until bytes have arrived, at most this long. Not for the tick path.
  bool wait_for_input(int milliseconds) const noexcept;
  /// The device was unplugged, or the system reports errors.
  bool lost() const noexcept { return lost_.load(std::memory_order_relaxed); }
  int descriptor() const noexcept { return descriptor_.number(); }

 private:
  SerialPort(Descriptor descriptor, std::unique_ptr<termios> before);

  Descriptor descriptor_;
  std::unique_ptr<termios> before_;
  std::atomic<bool> lost_{false};
};

}  // namespace palpable::device
