// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>

namespace palpable::page {

/// What to do with a received message.
enum class Verdict { accept, drop, disconnect };

struct RateLimits {
  /// Ten probes at 60 Hz, with a margin for other messages.
  double per_s = 1000.0;
  double burst = 1000.0;
  /// The client is disconnected after this many dropped messages without a pause of one second.
  int most_drops = 1000;
};

/// A steady clock's time, for RateLimit.
inline double seconds_now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// A token bucket: accepts `per_s` messages per second on average and bursts of `burst`, drops the excess,
/// and finally disconnects.
class RateLimit {
 public:
  explicit RateLimit(RateLimits limits) : limits_(limits), tokens_(limits.burst) {}

  /// `now_s` must not decrease.
  Verdict check(double now_s) {
    tokens_ = std::min(limits_.burst, tokens_ + (now_s - last_s_) * limits_.per_s);
    last_s_ = now_s;
    if (tokens_ >= 1.0) {
      tokens_ -= 1.0;
      if (now_s - last_drop_s_ > 1.0) dropped_ = 0;
      return Verdict::accept;
    }
    last_drop_s_ = now_s;
    return ++dropped_ > limits_.most_drops ? Verdict::disconnect : Verdict::drop;
  }

 private:
  RateLimits limits_;
  double tokens_;
  double last_s_ = 0.0;
  double last_drop_s_ = 0.0;
  int dropped_ = 0;
};

}  // namespace palpable::page
