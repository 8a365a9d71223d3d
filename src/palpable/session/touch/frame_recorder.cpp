// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/frame_recorder.hpp"

#include "palpable/sources/live/frame_folder.hpp"

#include <system_error>
#include <utility>

namespace palpable::session {

Result<std::unique_ptr<FrameRecorder>> FrameRecorder::open(const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) return Error{ErrorCode::failed, "cannot be made: " + failed.message(), folder.string()};
  if (sources::FrameFolder::open(folder))
    return Error{ErrorCode::usage, "holds frames already; frames are recorded to a folder without any",
                 folder.string()};
  return std::unique_ptr<FrameRecorder>(new FrameRecorder);
}

FrameRecorder::FrameRecorder() : thread_([this] { run(); }) {}

FrameRecorder::~FrameRecorder() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

std::optional<std::string> FrameRecorder::notice() {
  const std::lock_guard lock(mutex_);
  return std::exchange(unsaid_, std::nullopt);
}

bool FrameRecorder::keep(Write write) {
  constexpr std::size_t kMostWaiting = 8;
  {
    const std::lock_guard lock(mutex_);
    if (has_failed_) return false;
    if (waiting_.size() == kMostWaiting) {
      if (!std::exchange(said_slow_, true))
        unsaid_ = "Pictures come faster than they can be recorded; some are left out of the recording.";
      return false;
    }
    waiting_.push_back(std::move(write));
  }
  changed_.notify_all();
  return true;
}

/// Writes until the end, then what is left.
void FrameRecorder::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Write write = std::move(waiting_.front());
    waiting_.pop_front();
    lock.unlock();
    const auto written = write();
    lock.lock();
    if (written) continue;
    has_failed_ = true;
    waiting_.clear();
    unsaid_ = "The pictures are no longer recorded: " + written.error().sentence() + "; the touch goes on.";
  }
}

}  // namespace palpable::session
