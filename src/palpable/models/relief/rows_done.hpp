// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"

#include <cstdint>
#include <mutex>

namespace palpable::models {

/// The part of a whole work that one step of it is.
struct WorkPart {
  double begin = 0.0;
  double end = 1.0;
};

/// Counts finished rows of a ball's surface on all threads, and reports every hundredth.
class RowsDone {
 public:
  RowsDone(const Work& work, int rows, WorkPart part) : work_(work), rows_(rows), part_(part) {}
  void add() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (100 * done_ / rows_ != 100 * (done_ - 1) / rows_)
      work_.report(
          part_.begin + (part_.end - part_.begin) * static_cast<double>(done_) / static_cast<double>(rows_),
          "rolling the ball over the relief");
  }

 private:
  const Work& work_;
  std::int64_t rows_;
  WorkPart part_;
  std::mutex mutex_;
  std::int64_t done_ = 0;
};

}  // namespace palpable::models
