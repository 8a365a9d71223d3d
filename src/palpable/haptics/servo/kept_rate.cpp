// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/kept_rate.hpp"

#include "palpable/core/system/thread_priority.hpp"
#include "palpable/haptics/servo/pacing.hpp"
#include "palpable/haptics/servo/servo_loop.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

namespace palpable::haptics {

KeptRate measure_rate(double rate_hz, double seconds, int realtime_priority) {
  KeptRate kept{rate_hz, 0, 0};
  std::thread([&] {
    static_cast<void>(request_priority(realtime_priority));
    Pacer pacer(rate_hz, std::min(ServoOptions{}.watch_s, 0.5 / rate_hz));
    const double due = seconds * rate_hz;
    pacer.begin();
    while (static_cast<double>(kept.due) < due) {
      const std::uint32_t periods = pacer.wait().periods;
      kept.due += periods;
      kept.missed += periods - 1;
    }
  }).join();
  return kept;
}

Result<void> check_kept(const KeptRate& kept) {
  if (kept.missed_fraction() <= kMostMissedFraction) return {};
  const auto rounded = [](double value) { return std::to_string(std::lround(value)); };
  return Error{ErrorCode::failed,
               "this machine does not keep a loop of " + rounded(kept.rate_hz) +
                   " Hz now: an empty one missed " + rounded(100.0 * kept.missed_fraction()) +
                   " % of its deadlines, which leaves " +
                   rounded(kept.rate_hz * (1.0 - kept.missed_fraction())) + " Hz; choose a lower rate",
               {},
               Reason::rate_not_kept};
}

}  // namespace palpable::haptics
