// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/latency_recorder.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(LatencyRecorder, ComputesThePercentilesOfAKnownDistribution) {
  LatencyRecorder recorder;
  for (int i = 1; i <= 100000; ++i) recorder.record_ns(0.1 * i);
  const LatencySummary s = recorder.summary();
  EXPECT_EQ(s.count, 100000U);
  EXPECT_NEAR(s.p50_ns, 5000.0, 0.008 * 5000);
  EXPECT_NEAR(s.p99_ns, 9900.0, 0.008 * 9900);
  EXPECT_NEAR(s.p99_9_ns, 9990.0, 0.008 * 9990);
  EXPECT_NEAR(s.max_ns, 10000.0, 1.0 / 16);
}

TEST(LatencyRecorder, IsAccurateOverTwelveDecades) {
  for (double ns = 1.0; ns < 1e13; ns *= 1.37) {
    LatencyRecorder recorder;
    recorder.record_ns(ns);
    recorder.record_ns(2 * ns);
    recorder.record_ns(2 * ns);
    EXPECT_NEAR(recorder.summary().p50_ns, std::min(2 * ns, 1.4e13), 0.008 * 2 * ns + 0.07);
  }
}

TEST(LatencyRecorder, CountsOddValuesWithoutLosingItsMemory) {
  LatencyRecorder recorder;
  for (const double odd :
       {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300})
    recorder.record_ns(odd);
  EXPECT_EQ(recorder.summary().count, 4U);
  EXPECT_DOUBLE_EQ(recorder.summary().max_ns, 1.4e13);
  recorder.clear();
  EXPECT_EQ(recorder.summary().count, 0U);
  EXPECT_EQ(recorder.summary().max_ns, 0.0);
}

TEST(TickClock, AgreesWithTheSteadyClockAndSubtractsItsOwnCost) {
  using SteadyClock = std::chrono::steady_clock;
  const TickClock clock = TickClock::calibrate();
  EXPECT_GT(clock.ns_per_count(), 0.0);
  const auto begin = SteadyClock::now();
  const std::uint64_t first = TickClock::now();
  while (SteadyClock::now() - begin < std::chrono::milliseconds(20)) {
  }
  const std::uint64_t last = TickClock::now();
  const std::chrono::duration<double, std::nano> truth = SteadyClock::now() - begin;
  EXPECT_NEAR(clock.nanoseconds(first, last) / truth.count(), 1.0, 0.2);
  EXPECT_EQ(clock.nanoseconds(first, first), 0.0);
}

}  // namespace
}  // namespace palpable::haptics
