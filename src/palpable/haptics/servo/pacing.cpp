// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/pacing.hpp"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <ctime>

namespace palpable::haptics {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;
/// With less time than this before a deadline, only the clock is polled.
constexpr std::int64_t kSpare_ns = 50'000;

std::int64_t clock_ns(clockid_t clock) noexcept {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<std::int64_t>(time.tv_sec) * kSecond_ns + time.tv_nsec;
}

void sleep_until(std::int64_t ns) noexcept {
  const timespec time{static_cast<std::time_t>(ns / kSecond_ns), static_cast<long>(ns % kSecond_ns)};
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &time, nullptr) == EINTR) {
  }
}

}  // namespace

std::int64_t monotonic_ns() noexcept { return clock_ns(CLOCK_MONOTONIC); }

Pacer::Pacer(double rate_hz, double watch_s)
    : period_ns_(1e9 / rate_hz), watch_ns_(std::llround(1e9 * watch_s)) {}

void Pacer::begin() noexcept {
  begin_ns_ = monotonic_ns();
  last_ = 0;
  woke_ns_ = begin_ns_;
  woke_cpu_ns_ = clock_ns(CLOCK_THREAD_CPUTIME_ID);
}

std::int64_t Pacer::deadline_ns(std::int64_t k) const noexcept {
  return begin_ns_ + std::llround(static_cast<double>(k) * period_ns_);
}

Pacer::Wake Pacer::rest(double seconds) noexcept {
  sleep_until(monotonic_ns() + std::llround(1e9 * seconds));
  begin();
  Wake wake;
  wake.now_ns = begin_ns_;
  return wake;
}

bool Pacer::sleep() noexcept {
  using Cause = MissedDeadline::Cause;
  const std::int64_t deadline = deadline_ns(last_ + 1);
  const std::int64_t too_late = deadline_ns(last_ + 2);
  const std::int64_t arrived = monotonic_ns();
  slept_ = true;
  polls_ = arrived < too_late;
  coming_ = {};
  coming_.now_ns = arrived;
  if (!polls_) {
    const std::int64_t worked = clock_ns(CLOCK_THREAD_CPUTIME_ID) - woke_cpu_ns_;
    coming_.cause = 2 * worked > arrived - woke_ns_ ? Cause::slow_tick : Cause::held_up_in_tick;
    // The next deadline in the future; those before it were missed.
    const auto k =
        static_cast<std::int64_t>(std::floor(static_cast<double>(arrived - begin_ns_) / period_ns_)) + 1;
    coming_.late_us = 1e-3 * static_cast<double>(arrived - deadline);
    sleep_until(deadline_ns(k));
    coming_.now_ns = std::max(monotonic_ns(), deadline_ns(k));
    return false;
  }
  if (arrived < deadline - watch_ns_) sleep_until(deadline - watch_ns_);
  coming_.now_ns = monotonic_ns();
  coming_.cause = coming_.now_ns >= too_late ? Cause::late_wake : Cause::held_up_waiting;
  return coming_.now_ns < deadline - kSpare_ns;
}

Pacer::Wake Pacer::wait() noexcept {
  if (!slept_) sleep();
  slept_ = false;
  Wake wake = coming_;
  if (polls_) {
    const std::int64_t deadline = deadline_ns(last_ + 1);
    while (wake.now_ns < deadline) wake.now_ns = monotonic_ns();
    wake.late_us = 1e-3 * static_cast<double>(wake.now_ns - deadline);
  }
  const auto now =
      static_cast<std::int64_t>(std::floor(static_cast<double>(wake.now_ns - begin_ns_) / period_ns_));
  const std::int64_t reached = std::max(now, last_ + 1);
  wake.periods = static_cast<std::uint32_t>(reached - last_);
  last_ = reached;
  woke_ns_ = wake.now_ns;
  woke_cpu_ns_ = clock_ns(CLOCK_THREAD_CPUTIME_ID);
  return wake;
}

}  // namespace palpable::haptics
