// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace palpable::device {

/// The system's monotonic clock, which is the same in all processes, ns.
inline std::int64_t steady_ns() noexcept {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// While it exists, `since_ns` is the time at which it began: a call of a vendor's library is in progress.
class LibraryCall {
 public:
  explicit LibraryCall(std::atomic<std::int64_t>& since_ns) noexcept : since_ns_(since_ns) {
    since_ns_.store(steady_ns(), std::memory_order_release);
  }
  ~LibraryCall() { since_ns_.store(0, std::memory_order_release); }
  LibraryCall(const LibraryCall&) = delete;
  LibraryCall& operator=(const LibraryCall&) = delete;

 private:
  std::atomic<std::int64_t>& since_ns_;
};

/// An additional interface of devices whose library has a thread of its own, in which it calls the driver and
/// the driver calls it.
class CallsByThread {
 public:
  virtual ~CallsByThread() = default;
  /// Since when that thread has been in such a call, steady_ns(); 0: it is in none. Any thread.
  virtual std::int64_t in_call_since_ns() const noexcept = 0;
};

}  // namespace palpable::device
