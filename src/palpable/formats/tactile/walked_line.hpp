// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpable::formats {

/// Calls `visit` for points along the line, at most `step_m` apart; a single point is no line.
template <class Visit>
void walk_along(const Polyline& line, double step_m, const Visit& visit) {
  if (line.points.size() < 2) return;
  const std::size_t pieces = line.points.size() - (line.closed ? 0 : 1);
  for (std::size_t i = 0; i < pieces; ++i) {
    const Vec3 from = line.points[i], to = line.points[(i + 1) % line.points.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil(norm(to - from) / step_m)));
    for (int k = 0; k <= steps; ++k) visit(from + (static_cast<double>(k) / steps) * (to - from));
  }
}

}  // namespace palpable::formats
