// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/headless.hpp"

#include "palpable/haptics/pacing.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace palpable::session {
namespace {

constexpr auto kLook = std::chrono::milliseconds(20);

/// Runs a maker on its own thread, and holds what it delivers until it is taken.
class MakerThread {
 public:
  MakerThread(const SceneMaker& maker, const Work& work) : work_(work) {
    work_.cancel = &cancelled_;
    thread_ = std::thread([this, maker] {
      auto outcome = maker([this](auto scene) { deliver(std::move(scene)); }, work_);
      const std::lock_guard lock(mutex_);
      outcome_ = std::move(outcome);
      news_.notify_all();
    });
  }
  ~MakerThread() {
    cancelled_ = true;
    thread_.join();
  }
  MakerThread(const MakerThread&) = delete;
  MakerThread& operator=(const MakerThread&) = delete;

  void cancel() { cancelled_ = true; }

  /// Waits a moment for a scene.
  std::shared_ptr<const models::Scene> take() {
    std::unique_lock lock(mutex_);
    news_.wait_for(lock, kLook, [&] { return !scenes_.empty() || outcome_.has_value(); });
    if (scenes_.empty()) return nullptr;
    auto scene = std::move(scenes_.front());
    scenes_.pop_front();
    return scene;
  }
  /// How the maker ended; nothing while it runs.
  std::optional<Result<void>> outcome() {
    const std::lock_guard lock(mutex_);
    return outcome_;
  }

 private:
  void deliver(std::shared_ptr<const models::Scene> scene) {
    const std::lock_guard lock(mutex_);
    scenes_.push_back(std::move(scene));
    news_.notify_all();
  }

  Work work_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<std::shared_ptr<const models::Scene>> scenes_;
  std::optional<Result<void>> outcome_;
  std::thread thread_;
};

Result<std::shared_ptr<const models::Scene>> first_scene(MakerThread& maker, const Work& work) {
  while (!work.cancelled()) {
    if (auto scene = maker.take()) return scene;
    const auto outcome = maker.outcome();
    if (!outcome) continue;
    if (auto scene = maker.take()) return scene;
    if (!*outcome) return outcome->error();
    return Error{ErrorCode::failed, "no scene was made", {}};
  }
  return Work::interrupted();
}

}  // namespace

Result<TouchStatistics> touch_headless(const SceneMaker& make, const HeadlessOptions& options,
                                       const Work& work) {
  const std::int64_t begin_ns = options.begin_ns != 0 ? options.begin_ns : haptics::monotonic_ns();
  MakerThread maker(make, work);
  auto scene = first_scene(maker, work);
  if (!scene) return std::move(scene).error();
  auto opened =
      TouchSession::open(std::move(*scene), options.settings, options.device_url, options.session, begin_ns);
  if (!opened) return std::move(opened).error();
  TouchSession& session = **opened;
  if (!options.recording.empty())
    if (auto started = session.start_recording(options.recording); !started)
      return std::move(started).error();

  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(options.seconds);
  while (Clock::now() < end && !work.cancelled()) {
    const auto before = Clock::now();
    if (auto better = maker.take()) {
      if (auto changed = session.change_scene(std::move(better)); !changed) return std::move(changed).error();
    }
    for (const auto& missed : session.take_missed())
      if (options.on_missed) options.on_missed(missed);
    session.take_events();
    std::this_thread::sleep_until(before + kLook);
  }
  maker.cancel();
  auto recorded = session.stop_recording();
  session.stop();
  if (!recorded) return std::move(recorded).error();
  return session.statistics();
}

}  // namespace palpable::session
