// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palpable::session {

/// Writes frames to a folder (made if it is missing) on a thread of its own, so that frames:FOLDER shows them
/// again. What comes faster than it can be written is left out, which notice() says once; so it says that a
/// frame could not be written, after which none is. Any thread.
class FrameRecorder {
 public:
  /// Writes the files of one frame, all or none.
  using Write = std::function<Result<void>()>;

  /// Errors: usage if the folder holds frames already; failed, with the system's reason, if it cannot be
  /// made.
  static Result<std::unique_ptr<FrameRecorder>> open(const std::filesystem::path& folder);
  /// Writes what is left.
  ~FrameRecorder();
  FrameRecorder(const FrameRecorder&) = delete;
  FrameRecorder& operator=(const FrameRecorder&) = delete;

  /// False: it is left out.
  bool keep(Write write);
  std::optional<std::string> notice();

 private:
  FrameRecorder();
  void run();

  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Write> waiting_;
  bool ending_ = false, has_failed_ = false, said_slow_ = false;
  std::optional<std::string> unsaid_;
  std::thread thread_;
};

}  // namespace palpable::session
