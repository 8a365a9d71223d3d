// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

namespace palpable::session {

/// Tells frames that come after a newer one, by the times at which they were taken.
class FrameOrder {
 public:
  /// Whether this frame is older than one before, by less than a second: a clock that was set back farther
  /// begins anew. `stamp_s`: nullopt, or the same for all: not stated.
  bool is_late(std::optional<double> stamp_s) {
    constexpr double kSetBack_s = 1.0;
    if (!stamp_s) return false;
    if (newest_s_ && *stamp_s < *newest_s_ && *newest_s_ - *stamp_s < kSetBack_s) return true;
    newest_s_ = stamp_s;
    return false;
  }

 private:
  std::optional<double> newest_s_;
};

}  // namespace palpable::session
