// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_surface.hpp"

#include <cmath>
#include <vector>

namespace palpable::bench {

/// `places` points along a path 0.5 mm under a solid's surface, like a hand that presses while it explores.
template <models::DistanceSurface Distance>
std::vector<Vec3> path_under_surface(const Distance& field, int places) {
  std::vector<Vec3> path;
  const Vec3 origin = field.origin_m(), size = field.size_m();
  for (int i = 0; i < places; ++i) {
    const double t = 1e-4 * i;
    Vec3 p =
        origin + Vec3{size.x * (0.5 + 0.45 * std::sin(1.9 * t)), size.y * (0.5 + 0.45 * std::sin(3.1 * t)),
                      size.z * (0.5 + 0.45 * std::sin(4.3 * t))};
    for (int step = 0; step < 4; ++step) {
      const models::FieldSample s = field.sample(p);
      p -= (s.distance_m + 0.0005) * unit(s.gradient);
    }
    path.push_back(p);
  }
  return path;
}

}  // namespace palpable::bench
