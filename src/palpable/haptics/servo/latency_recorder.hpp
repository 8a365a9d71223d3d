// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>

#if defined(__x86_64__)
#include <x86intrin.h>
#endif

namespace palpable::haptics {

/// A clock with enough resolution for single ticks. It is the processor's time-stamp counter where there is
/// one (read in program order), else std::chrono::steady_clock. It assumes an invariant counter, which x86-64
/// processors have had since about 2010.
class TickClock {
 public:
  /// Measures the counter's rate and the cost of reading it; takes about 10 ms. Not for the tick path.
  static TickClock calibrate();

  /// Counts since an arbitrary start. Tick path.
  static std::uint64_t now() noexcept {
#if defined(__x86_64__)
    _mm_lfence();
    const std::uint64_t count = __rdtsc();
    _mm_lfence();
    return count;
#else
    return static_cast<std::uint64_t>(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
  }

  /// Nanoseconds between two readings minus the cost of reading; >= 0. Tick path.
  double nanoseconds(std::uint64_t start, std::uint64_t stop) const noexcept {
    const std::uint64_t counts = stop - start;
    return counts > own_cost_ ? static_cast<double>(counts - own_cost_) * ns_per_count_ : 0.0;
  }
  double ns_per_count() const noexcept { return ns_per_count_; }
  /// The cost of reading: the difference of two consecutive readings, in nanoseconds. nanoseconds() subtracts
  /// it.
  double own_cost_ns() const noexcept { return static_cast<double>(own_cost_) * ns_per_count_; }

 private:
  double ns_per_count_ = 1.0;
  std::uint64_t own_cost_ = 0;
};

/// Statistics of the recorded durations, in nanoseconds; all 0 if nothing was recorded. Percentiles are
/// accurate to 0.8 %, the maximum to 1/16 ns.
struct LatencySummary {
  std::uint64_t count = 0;
  double p50_ns = 0.0;
  double p99_ns = 0.0;
  double p99_9_ns = 0.0;
  double max_ns = 0.0;
};

/// A histogram of durations with logarithmic classes (128 per octave) in fixed memory, so that percentiles of
/// any number of ticks are available. One thread; record_ns() may be called on the tick path. To read it on
/// another thread, pass a copy.
class LatencyRecorder {
 public:
  /// Records a duration. Negative and non-finite durations count as 0; more than 4 hours count as 4 hours.
  /// Tick path.
  void record_ns(double ns) noexcept {
    constexpr double kLongest = 1.4e13;
    const double bounded = ns > 0.0 ? (ns < kLongest ? ns : kLongest) : 0.0;
    const auto units = static_cast<std::uint64_t>(bounded * kUnitsPerNs + 0.5);
    ++classes_[class_of(units)];
    ++count_;
    longest_ = units > longest_ ? units : longest_;
  }
  LatencySummary summary() const noexcept;
  void clear() noexcept { *this = LatencyRecorder{}; }

 private:
  static constexpr double kUnitsPerNs = 16.0;
  static constexpr int kBits = 7;
  static constexpr std::size_t kSubclasses = std::size_t{1} << kBits;
  static constexpr std::size_t kClasses = kSubclasses * 43;

  static std::size_t class_of(std::uint64_t units) noexcept {
    if (units < 2 * kSubclasses) return static_cast<std::size_t>(units);
    const int shift = static_cast<int>(std::bit_width(units)) - kBits - 1;
    return static_cast<std::size_t>(shift) * kSubclasses + static_cast<std::size_t>(units >> shift);
  }
  static double middle_of(std::size_t index) noexcept;
  double percentile_ns(double fraction) const noexcept;

  std::array<std::uint64_t, kClasses> classes_{};
  std::uint64_t count_ = 0;
  std::uint64_t longest_ = 0;
};

}  // namespace palpable::haptics
