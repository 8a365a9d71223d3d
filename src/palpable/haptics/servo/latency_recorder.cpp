// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/latency_recorder.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::haptics {

TickClock TickClock::calibrate() {
  using SteadyClock = std::chrono::steady_clock;
  TickClock clock;
  const auto begin = SteadyClock::now();
  const std::uint64_t first = now();
  auto end = begin;
  std::array<std::uint64_t, 4001> costs{};
  while (end - begin < std::chrono::milliseconds(10)) end = SteadyClock::now();
  const std::uint64_t last = now();
  for (auto& cost : costs) {
    const std::uint64_t start = now();
    cost = now() - start;
  }
  std::nth_element(costs.begin(), costs.begin() + costs.size() / 2, costs.end());
  clock.own_cost_ = costs[costs.size() / 2];
  clock.ns_per_count_ =
      static_cast<double>(std::chrono::duration_cast<std::chrono::nanoseconds>(end - begin).count()) /
      static_cast<double>(std::max<std::uint64_t>(1, last - first));
  return clock;
}

double LatencyRecorder::middle_of(std::size_t index) noexcept {
  if (index < 2 * kSubclasses) return static_cast<double>(index) / kUnitsPerNs;
  const std::size_t shift = index / kSubclasses - 1;
  const auto mantissa = static_cast<double>(index - shift * kSubclasses);
  return std::ldexp(mantissa + 0.5, static_cast<int>(shift)) / kUnitsPerNs;
}

double LatencyRecorder::percentile_ns(double fraction) const noexcept {
  const auto rank =
      static_cast<std::uint64_t>(std::max(1.0, std::ceil(fraction * static_cast<double>(count_))));
  std::uint64_t seen = 0;
  for (std::size_t i = 0; i < classes_.size(); ++i) {
    seen += classes_[i];
    if (seen >= rank) return std::min(middle_of(i), static_cast<double>(longest_) / kUnitsPerNs);
  }
  return static_cast<double>(longest_) / kUnitsPerNs;
}

LatencySummary LatencyRecorder::summary() const noexcept {
  if (count_ == 0) return {};
  return {count_, percentile_ns(0.5), percentile_ns(0.99), percentile_ns(0.999),
          static_cast<double>(longest_) / kUnitsPerNs};
}

}  // namespace palpable::haptics
