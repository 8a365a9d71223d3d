// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_surface.hpp"

#include <cmath>
#include <random>
#include <vector>

namespace palpable::bench {

/// The place 0.5 mm under the surface that is reached from `p` along the gradient.
template <models::DistanceSurface Distance>
Vec3 under_surface(const Distance& field, Vec3 p) {
  for (int step = 0; step < 4; ++step) {
    const models::FieldSample s = field.sample({p});
    p -= (s.distance_m + 0.0005) * unit(s.gradient.v);
  }
  return p;
}

/// `places` points along a path 0.5 mm under a solid's surface, like a hand that presses while it explores.
template <models::DistanceSurface Distance>
std::vector<Vec3> path_under_surface(const Distance& field, int places) {
  std::vector<Vec3> path;
  const Vec3 origin = field.origin_m(), size = field.size_m();
  for (int i = 0; i < places; ++i) {
    const double t = 1e-4 * i;
    const Vec3 p =
        origin + Vec3{size.x * (0.5 + 0.45 * std::sin(1.9 * t)), size.y * (0.5 + 0.45 * std::sin(3.1 * t)),
                      size.z * (0.5 + 0.45 * std::sin(4.3 * t))};
    path.push_back(under_surface(field, p));
  }
  return path;
}

/// The places of a hand that wanders at a constant speed, 0.5 mm under the surface, one each millisecond.
template <models::DistanceSurface Distance>
std::vector<Vec3> walk_under_surface(const Distance& field, int places, double speed_m_per_s) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  std::vector<Vec3> walk;
  Vec3 p = under_surface(field, field.origin_m() + 0.7 * field.size_m());
  Vec3 direction{1.0, 0.3, 0.2};
  // The direction turns by about 3 degrees in 0.1 mm.
  const double turn = 0.05 * std::sqrt(speed_m_per_s / 0.1);
  for (int i = 0; i < places; ++i) {
    walk.push_back(p);
    const double x = normal(random), y = normal(random), z = normal(random);
    const Vec3 outwards = unit(field.sample({p}).gradient.v);
    direction += turn * Vec3{x, y, z};
    direction = unit(direction - dot(direction, outwards) * outwards);
    p = under_surface(field, p + 1e-3 * speed_m_per_s * direction);
  }
  return walk;
}

}  // namespace palpable::bench
