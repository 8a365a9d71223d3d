// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/scene/route_guide.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {

bool is_valid(const RouteGuide& guide) {
  constexpr double kFarthest_m = 10.0, kLeastReach_m = 0.001, kMostReach_m = 0.05, kLeastAhead_m = 0.0005,
                   kMostAhead_m = 0.02;
  const auto is_near = [](const std::array<double, 2>& p) {
    return std::abs(p[0]) <= kFarthest_m && std::abs(p[1]) <= kFarthest_m;
  };
  return guide.line_m.size() > 1 && guide.line_m.size() <= kMaxGuidePoints &&
         std::all_of(guide.line_m.begin(), guide.line_m.end(), is_near) && guide.force_N >= 0.0 &&
         guide.force_N <= kMaxGuideForce_N && guide.reach_m >= kLeastReach_m &&
         guide.reach_m <= kMostReach_m && guide.ahead_m >= kLeastAhead_m && guide.ahead_m <= kMostAhead_m;
}

double length_m(const RouteGuide& guide) {
  double sum = 0.0;
  for (std::size_t i = 1; i < guide.line_m.size(); ++i)
    sum +=
        std::hypot(guide.line_m[i][0] - guide.line_m[i - 1][0], guide.line_m[i][1] - guide.line_m[i - 1][1]);
  return sum;
}

}  // namespace palpable::models
