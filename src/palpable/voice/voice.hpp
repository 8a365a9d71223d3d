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

/// What may push what aside while it waits to be said.
enum class Importance { label, news, fault };

/// Says sentences on a thread of its own, at most one in `gap`; what waits gives way to what is as important,
/// and is dropped when it is older than `lifetime`. Any thread may call say(); it never waits for the
/// speaker.
class Voice {
 public:
  struct Options {
    std::chrono::milliseconds gap{1000};
    std::chrono::milliseconds lifetime{2500};
  };
  explicit Voice(std::unique_ptr<Speaker> speaker) : Voice(std::move(speaker), Options{}) {}
  Voice(std::unique_ptr<Speaker> speaker, Options options);
  /// Drops what waits.
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
