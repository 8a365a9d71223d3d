// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::haptics {

/// How well this machine keeps a loop's rate now.
struct KeptRate {
  double rate_hz = 0.0;
  /// Deadlines that were due, and those that were missed.
  std::uint64_t due = 0;
  std::uint64_t missed = 0;
  double missed_fraction() const {
    return due > 0 ? static_cast<double>(missed) / static_cast<double>(due) : 1.0;
  }
};

/// A loop that misses more does not keep its rate.
inline constexpr double kMostMissedFraction = 0.2;

/// Runs an empty loop for `seconds` as the servo would: same pacing, same priority (0: ordinary), on a thread
/// of its own.
KeptRate measure_rate(double rate_hz, double seconds, int realtime_priority);

/// Errors (failed): the rate was not kept; the sentence holds the figures.
Result<void> check_kept(const KeptRate& kept);

}  // namespace palpable::haptics
