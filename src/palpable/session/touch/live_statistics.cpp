// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_statistics.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <limits>

namespace palpable::session {

LiveStatistics live_statistics(const LiveCounts& counts, std::chrono::steady_clock::time_point now) {
  const auto seconds = [](auto duration) { return std::chrono::duration<double>(duration).count(); };
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  auto latencies = counts.latencies_ms;
  const auto at = [&](double share) { return latencies.empty() ? kNone : quantile_of(latencies, share); };
  LiveStatistics live;
  live.frames = counts.arrived;
  live.dropped = counts.arrived - latencies.size();
  live.latency_p50_ms = at(0.5);
  live.latency_p99_ms = at(0.99);
  live.latency_max_ms = at(1.0);
  if (const double lasted_s = seconds(now - counts.begin); lasted_s > 0.0)
    live.fps = static_cast<double>(latencies.size()) / lasted_s;
  live.stale_s = latencies.empty() ? kNone : seconds(now - counts.newest_felt);
  return live;
}

}  // namespace palpable::session
