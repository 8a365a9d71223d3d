// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"

#include <atomic>
#include <cstdint>
#include <functional>
#include <string_view>

namespace palpable {

/// How a long computation runs: threads, progress, cancellation and seed. Passed by const reference to every
/// long function. Callbacks may come from any thread of the computation, one at a time.
struct Work {
  /// Number of threads; 0 = as many as the machine has.
  unsigned threads = 0;
  std::uint64_t seed = 1;
  /// Called with the finished fraction 0 ... 1 and the name of the current step; may be empty.
  std::function<void(double fraction, std::string_view what)> progress;
  /// Set by the user (Ctrl-C) and polled by the computation. May be null.
  const std::atomic<bool>* cancel = nullptr;

  bool cancelled() const { return cancel != nullptr && cancel->load(std::memory_order_relaxed); }
  void report(double fraction, std::string_view what) const {
    if (progress) progress(fraction, what);
  }
  unsigned thread_count() const;
  static Error interrupted() { return {ErrorCode::interrupted, "interrupted", {}}; }
};

/// Calls body(begin, end) over contiguous parts of [0, count) on work.thread_count() threads (the caller's
/// included) and waits. Parts have at least `grain` items. The parts depend only on count, grain and the
/// thread count. If body throws on any thread, the first exception is rethrown here after all have ended.
void parallel_for(const Work& work, int count, int grain,
                  const std::function<void(int begin, int end)>& body);

}  // namespace palpable
