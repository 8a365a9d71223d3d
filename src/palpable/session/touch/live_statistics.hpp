// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

namespace palpable::session {

/// How a live touch kept up with its source.
struct LiveStatistics {
  /// Frames that arrived, and those of them that were never felt.
  std::uint64_t frames = 0;
  std::uint64_t dropped = 0;
  /// Frames a second that were felt.
  double fps = 0.0;
  /// From the arrival of a frame to the first tick that knows it, ms; NaN if none was felt.
  double latency_p50_ms = 0.0;
  double latency_p99_ms = 0.0;
  double latency_max_ms = 0.0;
  /// Age of the newest felt frame, s.
  double stale_s = 0.0;
};

/// What the statistics are computed from.
struct LiveCounts {
  std::chrono::steady_clock::time_point begin;
  std::chrono::steady_clock::time_point newest_felt;
  std::uint64_t arrived = 0;
  /// One for each felt frame.
  std::vector<double> latencies_ms;
};

/// The statistics at the time `now`.
LiveStatistics live_statistics(const LiveCounts& counts, std::chrono::steady_clock::time_point now);

}  // namespace palpable::session
