// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/device/device.hpp"
#include "palpable/device/hosted/exchange.hpp"

#include <atomic>
#include <cstdint>
#include <thread>

namespace palpable::device {

/// Serves a device to the program that started this process: answers its questions for positions and writes
/// its forces, on the thread that calls serve(). Another thread watches the program's end and calls of the
/// library that do not return. If no force comes for 5 ms (CommandHandOff), it writes zero.
class LibraryHost {
 public:
  /// Both must outlive it, the device until serve() has returned.
  LibraryHost(Device& device, HostExchange& shared);
  ~LibraryHost();
  LibraryHost(const LibraryHost&) = delete;
  LibraryHost& operator=(const LibraryHost&) = delete;

  /// Returns when the program has ended or asked for the end; the motors are free.
  void serve();
  /// The device was closed.
  void note_closed() noexcept { shared_.stage.store(HostStage::closed, std::memory_order_release); }

 private:
  void answer();
  void write_newest(double elapsed_s);
  void tell_texts();
  void watch() noexcept;
  void end_watch();
  std::int64_t note_calls() noexcept;

  Device& device_;
  /// Null if its library has no thread of its own.
  const CallsByThread* calls_by_thread_;
  HostExchange& shared_;
  std::atomic<bool> ending_{false};
  std::atomic<bool> served_{false};
  // The serving thread's.
  std::uint32_t puts_ = 0;
  bool pushes_ = false;
  Status told_ = Status::ok;
  unsigned since_told_ = 0;
  std::thread watch_;
};

}  // namespace palpable::device
