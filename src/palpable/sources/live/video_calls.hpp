// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstddef>

namespace palpable::sources {

/// The system's calls for video devices, so that tests can stand in for a camera. Each sets errno as the call
/// that it is named after.
class VideoCalls {
 public:
  VideoCalls() = default;
  virtual ~VideoCalls() = default;
  VideoCalls(const VideoCalls&) = delete;
  VideoCalls& operator=(const VideoCalls&) = delete;

  /// For reading and writing, without waiting; -1: failed.
  virtual int open(const char* path) = 0;
  virtual void close(int descriptor) = 0;
  /// -1: failed. Tried again where a signal interrupted it.
  virtual int control(int descriptor, unsigned long request, void* argument) = 0;
  /// A buffer of the device, shared with this process; null: failed.
  virtual void* map(int descriptor, std::size_t bytes, std::size_t offset) = 0;
  virtual void unmap(void* begin, std::size_t bytes) = 0;
  /// Waits until a picture is there, or the device has a fault, at most this long.
  virtual void wait(int descriptor, std::chrono::milliseconds longest) = 0;
};

/// Those of Linux (V4L2).
VideoCalls& system_video_calls();

}  // namespace palpable::sources
