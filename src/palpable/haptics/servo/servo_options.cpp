// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/servo_options.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace palpable::haptics {

TickOptions tick_options(const ServoOptions& options) {
  TickOptions tick = options.tick;
  tick.stall_s = std::max(tick.stall_s, 3.0 / options.rate_hz);
  tick.max_rise_time_s = 1.5 / options.rate_hz;
  return tick;
}

ServoOptions for_rate(ServoOptions options) {
  options.tick = tick_options(options);
  options.watch_s = std::min(options.watch_s, 0.5 / options.rate_hz);
  return options;
}

Result<void> check(const ServoOptions& options) {
  const auto usage = [](std::string message) { return Error{ErrorCode::usage, std::move(message), {}}; };
  if (!(options.rate_hz >= 100.0 && options.rate_hz <= 4000.0))
    return usage("the loop rate must be 100 to 4000 Hz");
  if (const auto valid = check(options.tick); !valid) return valid.error();
  if (options.recording_capacity < 1) return usage("a recording needs room for at least one sample");
  if (options.realtime_priority < 0 || options.realtime_priority > 99)
    return usage("the real-time priority must be 0 to 99");
  if (!(options.watch_s >= 0.0)) return usage("the time to watch the clock must be at least 0 s");
  if (!(options.rest_after_s > 0.0)) return usage("the time before a rest must be above 0 s");
  if (!(options.rest_period_s >= 0.001 && options.rest_period_s <= 0.1))
    return usage("the period of a resting loop must be 0.001 to 0.1 s");
  return {};
}

}  // namespace palpable::haptics
