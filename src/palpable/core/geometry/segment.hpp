// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>

namespace palpable {

// Straight segments a … b in the plane. `Place` is any type with members x and y; a third one is not used.

/// Where on the segment its nearest point to `p` is: 0 at `a`, 1 at `b`. 0 if both are the same.
template <class Place>
double nearest_share(const Place& p, const Place& a, const Place& b) noexcept {
  const double dx = b.x - a.x, dy = b.y - a.y, square = dx * dx + dy * dy;
  return square > 0.0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / square, 0.0, 1.0) : 0.0;
}

/// The distance of `p` from the segment, in the unit of its coordinates.
template <class Place>
double distance_to_segment(const Place& p, const Place& a, const Place& b) noexcept {
  const double t = nearest_share(p, a, b);
  return std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y));
}

}  // namespace palpable
