// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// The distance outside the box in which a field is sampled. Positions are relative to the box's least corner.

#include "palpable/core/vec3.hpp"
#include "palpable/models/field/distance_sample.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {

inline Vec3 nearest_in_box(Vec3 place_m, Vec3 size_m) noexcept {
  // Written so that NaN becomes 0.
  const auto held = [](double v, double n) { return v > 0.0 ? (v < n ? v : n) : 0.0; };
  return {held(place_m.x, size_m.x), held(place_m.y, size_m.y), held(place_m.z, size_m.z)};
}

/// Where the segment from `place_m`, outside the box, to `inside_m`, in it, enters the box.
inline Vec3 entry_into_box(Vec3 place_m, Vec3 inside_m, Vec3 size_m) noexcept {
  double share = 0.0;
  const auto pass = [&share](double from, double to, double bound) {
    if (from < 0.0) share = std::max(share, from / (from - to));
    if (from > bound) share = std::max(share, (from - bound) / (from - to));
  };
  pass(place_m.x, inside_m.x, size_m.x);
  pass(place_m.y, inside_m.y, size_m.y);
  pass(place_m.z, inside_m.z, size_m.z);
  return nearest_in_box(place_m + std::min(share, 1.0) * (inside_m - place_m), size_m);
}

/// The distance of a solid inside the box from a place outside: the least |place - b| + D(b) over places b of
/// the box, where D = `inside(b)` is the field's own. It is that of the segment to the nearest point of the
/// solid, which is found by following D's gradient from b, and b anew from that segment, in a fixed number of
/// rounds. Each round shortens the way, so the result is continuous and at least the solid's distance. Where
/// D(b) <= 0, as for a solid that the box cuts, it is the distance to b plus D. Tick path.
template <class Inside>
DistanceSample outside_box(Vec3 place_m, Vec3 size_m, const Inside& inside) noexcept {
  constexpr int kRounds = 4;
  Vec3 at_m = nearest_in_box(place_m, size_m);
  DistanceSample s = inside(at_m);
  for (int round = 0; round < kRounds && s.distance_m > 0.0; ++round) {
    const double length = norm(s.gradient);
    if (!(length > 0.0)) break;
    const Vec3 surface_m = nearest_in_box(at_m - (s.distance_m / length) * s.gradient, size_m);
    const Vec3 next_m = entry_into_box(place_m, surface_m, size_m);
    if (next_m == at_m) break;
    const DistanceSample next = inside(next_m);
    // Far from the surface a field's distance and direction are less exact.
    if (norm(place_m - next_m) + next.distance_m >= norm(place_m - at_m) + s.distance_m) break;
    at_m = next_m;
    s = next;
  }
  const Vec3 way_m = place_m - at_m;
  const double length_m = norm(way_m);
  if (length_m > 0.0) {
    s.distance_m += length_m;
    s.gradient = way_m / length_m;
  }
  return s;
}

/// A lower bound of the distance of a solid inside the box from a place outside, where outside_box() gave
/// `distance_m`. A ball around the nearest place of the box, whose radius is D there, is empty, and the angle
/// between the ways from that place to `place_m` and to any place of the box is at least a right one.
inline double least_outside_box(Vec3 place_m, Vec3 size_m, double distance_m) noexcept {
  const double beyond_m = norm(place_m - nearest_in_box(place_m, size_m));
  return std::hypot(beyond_m, std::max(0.0, distance_m - beyond_m));
}

}  // namespace palpable::models
