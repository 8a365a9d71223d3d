// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/maker_thread.hpp"

#include <new>
#include <utility>

namespace palpable::session {

MakerThread::MakerThread(const SceneMaker& maker, const Work& work) : work_(work) {
  work_.cancel = &cancelled_;
  thread_ = std::thread([this, maker] {
    Result<void> outcome;
    try {
      outcome = maker([this](auto scene) { deliver(std::move(scene)); }, work_);
    } catch (const std::bad_alloc&) {
      outcome = Error{ErrorCode::failed, "there is not enough memory for this scene", {}};
    }
    const std::lock_guard lock(mutex_);
    outcome_ = std::move(outcome);
    news_.notify_all();
  });
}

MakerThread::~MakerThread() {
  cancelled_ = true;
  thread_.join();
}

std::shared_ptr<const models::Scene> MakerThread::take(std::chrono::milliseconds patience) {
  std::unique_lock lock(mutex_);
  news_.wait_for(lock, patience, [&] { return !scenes_.empty() || outcome_.has_value(); });
  if (scenes_.empty()) return nullptr;
  auto scene = std::move(scenes_.front());
  scenes_.pop_front();
  return scene;
}

std::optional<Result<void>> MakerThread::outcome() {
  const std::lock_guard lock(mutex_);
  return outcome_;
}

Result<std::shared_ptr<const models::Scene>> MakerThread::first_scene(const Work& work) {
  constexpr std::chrono::milliseconds kLook(20);
  while (!work.cancelled()) {
    if (auto scene = take(kLook)) return scene;
    const auto ended = outcome();
    if (!ended) continue;
    if (auto scene = take(kLook)) return scene;
    if (!*ended) return ended->error();
    return Error{ErrorCode::failed, "no scene was made", {}};
  }
  return Work::interrupted();
}

Result<std::shared_ptr<const models::Scene>> MakerThread::last_scene(const Work& work) {
  auto last = first_scene(work);
  if (!last) return last;
  constexpr std::chrono::milliseconds kLook(20);
  while (!work.cancelled()) {
    const auto ended = outcome();
    while (auto better = take(kLook)) last = std::move(better);
    if (!ended) continue;
    if (!*ended) return ended->error();
    return last;
  }
  return Work::interrupted();
}

void MakerThread::deliver(std::shared_ptr<const models::Scene> scene) {
  const std::lock_guard lock(mutex_);
  scenes_.push_back(std::move(scene));
  news_.notify_all();
}

}  // namespace palpable::session
