// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/recorded_pairs.hpp"

#include "palpable/core/files/atomic_files.hpp"
#include "palpable/formats/picture/png.hpp"
#include "palpable/sources/live/frame_folder.hpp"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>

#include <fmt/format.h>

namespace palpable::session {
namespace {

namespace fs = std::filesystem;

Result<void> write_pair(const fs::path& folder, const LivePair& pair) {
  AtomicFiles files;
  for (const auto& [picture, side] : {std::pair(&pair.left, "left"), {&pair.right, "right"}}) {
    const auto file = formats::encode_png(*picture);
    if (!file) return file.error();
    if (auto added = files.add(folder / fmt::format("{:06}.{}.png", pair.number, side), *file); !added)
      return added;
  }
  return files.commit();
}

class RecordedPairs final : public PairSource {
 public:
  RecordedPairs(std::unique_ptr<PairSource> pairs, fs::path folder)
      : pairs_(std::move(pairs)), folder_(std::move(folder)), thread_([this] { run(); }) {}
  ~RecordedPairs() override {
    {
      const std::lock_guard lock(mutex_);
      ending_ = true;
    }
    changed_.notify_all();
    thread_.join();
  }

  Result<std::optional<LivePair>> take(std::chrono::steady_clock::time_point deadline) override {
    auto pair = pairs_->take(deadline);
    if (pair && *pair) keep(**pair);
    return pair;
  }
  bool has_ended() const override { return pairs_->has_ended(); }
  std::optional<std::string> loss() override { return pairs_->loss(); }
  std::optional<std::string> notice() override {
    const std::lock_guard lock(mutex_);
    return std::exchange(unsaid_, std::nullopt);
  }

 private:
  void keep(const LivePair& pair) {
    constexpr std::size_t kMostWaiting = 8;
    {
      const std::lock_guard lock(mutex_);
      if (has_failed_) return;
      if (waiting_.size() == kMostWaiting) {
        if (!std::exchange(said_slow_, true))
          unsaid_ = "Pictures come faster than they can be recorded; some are left out of the recording.";
        return;
      }
      waiting_.push_back(pair);
    }
    changed_.notify_all();
  }

  /// Writes until the end, then what is left.
  void run() {
    std::unique_lock lock(mutex_);
    while (true) {
      changed_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
      if (waiting_.empty()) return;
      const LivePair pair = std::move(waiting_.front());
      waiting_.pop_front();
      lock.unlock();
      const auto written = write_pair(folder_, pair);
      lock.lock();
      if (written) continue;
      has_failed_ = true;
      waiting_.clear();
      unsaid_ = "The pictures are no longer recorded: " + written.error().sentence() + "; the touch goes on.";
    }
  }

  std::unique_ptr<PairSource> pairs_;
  fs::path folder_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<LivePair> waiting_;
  bool ending_ = false, has_failed_ = false, said_slow_ = false;
  std::optional<std::string> unsaid_;
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<PairSource>> recorded_pairs(std::unique_ptr<PairSource> pairs,
                                                   const fs::path& folder) {
  std::error_code failed;
  fs::create_directories(folder, failed);
  if (failed) return Error{ErrorCode::failed, "cannot be made: " + failed.message(), folder.string()};
  if (sources::FrameFolder::open(folder))
    return Error{ErrorCode::usage, "holds frames already; frames are recorded to a folder without any",
                 folder.string()};
  return std::unique_ptr<PairSource>(std::make_unique<RecordedPairs>(std::move(pairs), folder));
}

}  // namespace palpable::session
