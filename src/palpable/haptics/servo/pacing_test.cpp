// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/pacing.hpp"

#include <chrono>
#include <cstdint>
#include <ctime>
#include <thread>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

// These tests do not depend on the speed of the machine; they compare clock readings with each other.

TEST(Pacer, NeverWakesBeforeItsDeadlineAndCountsEveryPeriodOnce) {
  Pacer pacer(1000.0, 100e-6);
  pacer.begin();
  std::int64_t k = 0;
  for (int i = 0; i < 100; ++i) {
    const auto wake = pacer.wait();
    k += wake.periods;
    EXPECT_GE(wake.now_ns, pacer.deadline_ns(k));
    EXPECT_LT(wake.now_ns, pacer.deadline_ns(k + 1));
  }
  EXPECT_GE(k, 100);
}

TEST(Pacer, SleepsUntilPollingBeginsAndWaitsForTheSameDeadline) {
  Pacer pacer(1000.0, 300e-6);
  pacer.begin();
  std::int64_t k = 0;
  int spare = 0;
  for (int i = 0; i < 100; ++i) {
    const bool has_time = pacer.sleep();
    const std::int64_t slept_ns = monotonic_ns();
    const auto wake = pacer.wait();
    if (has_time && wake.periods == 1) {
      ++spare;
      EXPECT_GE(slept_ns, pacer.deadline_ns(k + 1) - 300'000);
    }
    k += wake.periods;
    EXPECT_GE(wake.now_ns, pacer.deadline_ns(k));
    EXPECT_LT(wake.now_ns, pacer.deadline_ns(k + 1));
  }
  EXPECT_GT(spare, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(5));
  EXPECT_FALSE(pacer.sleep());
  EXPECT_EQ(pacer.wait().cause, MissedDeadline::Cause::held_up_in_tick);
}

TEST(Pacer, SkipsMissedDeadlinesWithoutCatchingUpInABurst) {
  Pacer pacer(1000.0, 100e-6);
  pacer.begin();
  pacer.wait();
  std::this_thread::sleep_for(std::chrono::milliseconds(12));
  const auto after = pacer.wait();
  EXPECT_GE(after.periods, 12U);
  // A sleeping thread does not work: it does not use the processor.
  EXPECT_EQ(after.cause, MissedDeadline::Cause::held_up_in_tick);
  const auto next = pacer.wait();
  EXPECT_GT(next.now_ns - after.now_ns, 0);
  EXPECT_GE(next.periods, 1U);
}

TEST(Pacer, DetectsATickThatTookTooLongItself) {
  Pacer pacer(1000.0, 100e-6);
  pacer.begin();
  pacer.wait();
  // Works for 5 ms of processor time, regardless of wall time.
  const auto processor_ns = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<std::int64_t>(time.tv_sec) * 1'000'000'000 + time.tv_nsec;
  };
  const std::int64_t begin_wall = monotonic_ns();
  const std::int64_t begin = processor_ns();
  while (processor_ns() - begin < 5'000'000) {
  }
  const std::int64_t wall = monotonic_ns() - begin_wall;
  const auto wake = pacer.wait();
  EXPECT_GE(wake.periods, 5U);
  // If the thread was preempted for longer than it worked, the preemption is reported.
  if (wall < 9'000'000) {
    EXPECT_EQ(wake.cause, MissedDeadline::Cause::slow_tick);
  }
}

TEST(Pacer, DoesNotDriftOverAnHour) {
  const Pacer pacer(997.0, 0.0);
  const double hour = 3600.0;
  const auto last = static_cast<std::int64_t>(hour * 997.0);
  EXPECT_NEAR(static_cast<double>(pacer.deadline_ns(last) - pacer.deadline_ns(0)), hour * 1e9, 2.0);
}

}  // namespace
}  // namespace palpable::haptics
