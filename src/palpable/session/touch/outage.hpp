// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

namespace palpable::session {

/// When a person is told that something does not work, and that it works again: once each, however often it
/// fails in quick succession. Times are seconds of any one clock.
class Outage {
 public:
  /// It has ended when it has worked for this long.
  static constexpr double kSettled_s = 0.5;

  /// It fails: whether that is to be told.
  bool begin() {
    works_since_s_ = kNever_s;
    return !std::exchange(is_told_, true);
  }
  /// It works, perhaps for a short time only.
  void note_works(double now_s) {
    if (is_told_) works_since_s_ = std::min(works_since_s_, now_s);
  }
  /// True once after each outage that was told.
  bool take_end(double now_s) {
    if (now_s - works_since_s_ < kSettled_s) return false;
    works_since_s_ = kNever_s;
    is_told_ = false;
    return true;
  }

 private:
  static constexpr double kNever_s = std::numeric_limits<double>::infinity();
  bool is_told_ = false;
  double works_since_s_ = kNever_s;
};

}  // namespace palpable::session
