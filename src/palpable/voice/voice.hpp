// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/voice/speaker.hpp"

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace palpable::voice {

/// Priority of a sentence while it waits to be spoken, lowest first.
enum class Importance { label, news, fault };

/// Speaks sentences on its own thread, at most one per `gap`. A waiting sentence is replaced by a new one of
/// equal or higher importance, and dropped when it is older than `lifetime`. Any thread may call say(), which
/// never waits for the speaker.
class Voice {
 public:
  struct Options {
    std::chrono::milliseconds gap{1000};
    std::chrono::milliseconds lifetime{2500};
  };
  explicit Voice(std::unique_ptr<Speaker> speaker) : Voice(std::move(speaker), Options{}) {}
  Voice(std::unique_ptr<Speaker> speaker, Options options);
  /// Drops the waiting sentence.
  ~Voice();
  Voice(const Voice&) = delete;
  Voice& operator=(const Voice&) = delete;

  void say(Importance importance, std::string sentence);

 private:
  using Clock = std::chrono::steady_clock;
  struct Waiting {
    std::string sentence;
    Importance importance = Importance::label;
    Clock::time_point until;
  };
  void work();

  std::unique_ptr<Speaker> speaker_;
  Options options_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::optional<Waiting> waiting_;
  bool ending_ = false;
  std::thread thread_;
};

}  // namespace palpable::voice
