// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace palpable::session {

/// Sentences for a person, each once, in their order. Any thread.
class Notices {
 public:
  void put(std::string sentence) {
    const std::lock_guard lock(mutex_);
    sentences_.push_back(std::move(sentence));
  }
  std::optional<std::string> take() {
    const std::lock_guard lock(mutex_);
    if (sentences_.empty()) return std::nullopt;
    std::string first = std::move(sentences_.front());
    sentences_.pop_front();
    return first;
  }

 private:
  std::mutex mutex_;
  std::deque<std::string> sentences_;
};

}  // namespace palpable::session
