// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <vector>

namespace palpable::models {

/// Greatest force of a guide, and its most points.
inline constexpr double kMaxGuideForce_N = 1.0;
inline constexpr std::size_t kMaxGuidePoints = 10000;

/// A way along which a hand is pulled gently. Lengths in the scene frame.
struct RouteGuide {
  /// Places x, y from its beginning to its end, metres; at least two, at most kMaxGuidePoints.
  std::vector<std::array<double, 2>> line_m;
  /// Greatest pull, 0 ... kMaxGuideForce_N.
  double force_N = 0.3;
  /// How far beside the way the pull ends, 1 ... 50 mm. From half of it on it becomes weaker.
  double reach_m = 0.008;
  /// How far ahead on the way the pull is directed, 0.5 ... 20 mm; it becomes weaker as near as this to the
  /// end.
  double ahead_m = 0.003;

  bool operator==(const RouteGuide&) const = default;
};

/// Whether every number is finite and in range.
bool is_valid(const RouteGuide& guide);

/// Length of its line, metres.
double length_m(const RouteGuide& guide);

}  // namespace palpable::models
