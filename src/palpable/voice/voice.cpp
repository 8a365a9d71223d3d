// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/voice/voice.hpp"

#include <utility>

namespace palpable::voice {

Voice::Voice(std::unique_ptr<Speaker> speaker, Options options)
    : speaker_(std::move(speaker)), options_(options), thread_([this] { work(); }) {}

Voice::~Voice() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Voice::say(Importance importance, std::string sentence) {
  {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    if (waiting_ && waiting_->until >= now && importance < waiting_->importance) return;
    waiting_ = Waiting{std::move(sentence), importance, now + options_.lifetime};
  }
  wake_.notify_one();
}

void Voice::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    wake_.wait(lock, [this] { return ending_ || waiting_; });
    if (ending_) return;
    const Waiting next = *std::exchange(waiting_, std::nullopt);
    if (next.until < Clock::now()) continue;
    lock.unlock();
    const bool spoke = static_cast<bool>(speaker_->say(next.sentence));
    lock.lock();
    // After an error the touch goes on without speech.
    if (!spoke) return;
    if (wake_.wait_for(lock, options_.gap, [this] { return ending_; })) return;
  }
}

}  // namespace palpable::voice
