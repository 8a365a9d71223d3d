// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

namespace palpable::device {

/// Notices an encoder that stands still while the handle moves: its value does not change at all, while that
/// of another one changes by `Limits::moved`. A hand does not hold one joint to a single count for long while
/// it turns another one, except at the joint's stop; so only readings inside the workspace count. Tick path.
template <std::size_t kJoints>
class StuckEncoder {
 public:
  /// `moved`: the way of another joint, in the unit of the readings, after which a still one is stuck.
  explicit StuckEncoder(double moved) noexcept : moved_(moved) {}

  /// The number of the stuck joint, from 0.
  std::optional<std::size_t> follow(const std::array<double, kJoints>& values,
                                    bool inside_workspace) noexcept {
    if (!begun_ || !inside_workspace) {
      changed_at_.fill(values);
      begun_ = true;
      return {};
    }
    std::optional<std::size_t> stuck;
    for (std::size_t k = 0; k < kJoints; ++k) {
      if (values[k] != changed_at_[k][k]) changed_at_[k] = values;
      // Not the whole way: a handle at rest may tremble between two counts for ever.
      for (std::size_t other = 0; other < kJoints; ++other)
        if (std::abs(values[other] - changed_at_[k][other]) > moved_) stuck = k;
    }
    return stuck;
  }

 private:
  double moved_;
  bool begun_ = false;
  /// For each joint: all values when it last changed.
  std::array<std::array<double, kJoints>, kJoints> changed_at_{};
};

}  // namespace palpable::device
