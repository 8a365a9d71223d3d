// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/scene/scene.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

namespace palpable::session {

/// Takes a scene as soon as it can be touched; called again when a better one is ready.
using DeliverScene = std::function<void(std::shared_ptr<const models::Scene>)>;
/// Makes scenes, the one that is ready soonest first, and delivers each. Runs on a separate thread; polls
/// work.cancelled().
using SceneMaker = std::function<Result<void>(const DeliverScene& deliver, const Work& work)>;

/// Runs a maker on a separate thread and keeps the scenes that it delivers until they are taken. The
/// destructor cancels the maker and waits for it.
class MakerThread {
 public:
  MakerThread(const SceneMaker& maker, const Work& work);
  ~MakerThread();
  MakerThread(const MakerThread&) = delete;
  MakerThread& operator=(const MakerThread&) = delete;

  void cancel() { cancelled_ = true; }
  /// The next scene; null if none arrives within `patience`, or the maker has ended.
  std::shared_ptr<const models::Scene> take(std::chrono::milliseconds patience);
  /// The maker's result; nullopt while it runs.
  std::optional<Result<void>> outcome();
  /// Waits for the first scene. Errors: those of the maker; interrupted if work is cancelled first.
  Result<std::shared_ptr<const models::Scene>> first_scene(const Work& work);
  /// Waits until the maker has ended; its last scene, the best one. Errors: as first_scene(); the maker's,
  /// even if there was a scene.
  Result<std::shared_ptr<const models::Scene>> last_scene(const Work& work);

 private:
  void deliver(std::shared_ptr<const models::Scene> scene);

  Work work_;
  std::atomic<bool> cancelled_{false};
  std::mutex mutex_;
  std::condition_variable news_;
  std::deque<std::shared_ptr<const models::Scene>> scenes_;
  std::optional<Result<void>> outcome_;
  std::thread thread_;
};

}  // namespace palpable::session
