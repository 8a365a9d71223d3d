// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

namespace palpable::session {

/// When a robot measured what it sends, by our clock: its own clock shows by how much a message was later
/// than the quickest one of the last five seconds. One thread.
class MeasuredTime {
 public:
  /// `stamp_s`: by the robot's clock; nullopt: not stated, so that a message is as old as its arrival says.
  double of(double arrival_s, std::optional<double> stamp_s) {
    // More is no delay, but a clock that was set.
    constexpr double kWindow_s = 5.0, kMostDelay_s = 2.0;
    if (!stamp_s) return arrival_s;
    const double behind_s = arrival_s - *stamp_s;
    while (!least_.empty() && least_.back().second >= behind_s) least_.pop_back();
    least_.emplace_back(arrival_s, behind_s);
    while (arrival_s - least_.front().first > kWindow_s) least_.pop_front();
    return arrival_s - std::min(behind_s - least_.front().second, kMostDelay_s);
  }

 private:
  /// When they arrived and how far they were behind, the least one first.
  std::deque<std::pair<double, double>> least_;
};

}  // namespace palpable::session
