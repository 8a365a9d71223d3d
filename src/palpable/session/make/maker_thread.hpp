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
/// Makes scenes, the fastest first, and delivers each. Runs on a thread of its own; polls work.cancelled().
using SceneMaker = std::function<Result<void>(const DeliverScene& deliver, const Work& work)>;

/// Runs a maker on its own thread, and holds what it delivers until it is taken. Its destructor cancels the
/// maker and waits for it.
class MakerThread {
 public:
  MakerThread(const SceneMaker& maker, const Work& work);
  ~MakerThread();
  MakerThread(const MakerThread&) = delete;
  MakerThread& operator=(const MakerThread&) = delete;

  void cancel() { cancelled_ = true; }
  /// The next scene; null if none came within `patience`, or the maker has ended.
  std::shared_ptr<const models::Scene> take(std::chrono::milliseconds patience);
  /// How the maker ended; nothing while it runs.
  std::optional<Result<void>> outcome();
  /// Waits for the first scene. Errors: the maker's; interrupted, when work is cancelled before.
  Result<std::shared_ptr<const models::Scene>> first_scene(const Work& work);

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
