// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <cstdint>

namespace palpable::haptics {

/// How well this machine keeps a loop's rate at present.
struct KeptRate {
  double rate_hz = 0.0;
  /// Number of deadlines, and of missed ones.
  std::uint64_t due = 0;
  std::uint64_t missed = 0;
  double missed_fraction() const {
    return due > 0 ? static_cast<double>(missed) / static_cast<double>(due) : 1.0;
  }
};

/// A loop that misses a larger fraction does not keep its rate.
inline constexpr double kMostMissedFraction = 0.2;

/// Runs an empty loop for `seconds` on a separate thread, with the servo's pacing and priority (0: normal
/// scheduling).
KeptRate measure_rate(double rate_hz, double seconds, int realtime_priority);

/// Errors (failed): the rate was not kept; the sentence holds the figures.
Result<void> check_kept(const KeptRate& kept);

}  // namespace palpable::haptics
