// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>

namespace palpable::page {

/// What to do with a message that came in.
enum class Verdict { accept, drop, disconnect };

struct RateLimits {
  /// Ten probes sixty times a second, and room for the rest.
  double per_s = 1000.0;
  double burst = 1000.0;
  /// After so many messages dropped without a pause of a second, the client is disconnected.
  int most_drops = 1000;
};

/// A token bucket: lets `per_s` messages through on average, bursts of `burst`; drops more, then gives up.
class RateLimit {
 public:
  explicit RateLimit(RateLimits limits) : limits_(limits), tokens_(limits.burst) {}

  /// `now_s` must not go backwards.
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
