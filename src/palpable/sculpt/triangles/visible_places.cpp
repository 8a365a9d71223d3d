// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/visible_places.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace palpable::sculpt {
namespace {

/// The k-th of `count` directions on a spiral over the sphere.
Vec3 spiral_direction(int k, int count) {
  const double z = 1.0 - (2.0 * k + 1.0) / count, turn = k * std::numbers::pi * (3.0 - std::sqrt(5.0));
  const double out = std::sqrt(1.0 - z * z);
  return {out * std::cos(turn), out * std::sin(turn), z};
}

}  // namespace

std::vector<Vec3> visible_places(const TriangleTree& tree, const ViewOptions& options, std::uint64_t seed) {
  PALPABLE_CHECK(options.directions >= 1 && options.rays >= 1 && options.beside_m >= 0.0);
  const Box box = tree.bounds();
  const Vec3 middle = 0.5 * (box.least_m + box.most_m);
  const double radius_m = 0.5 * norm(box.size_m());
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> across_m(-radius_m, radius_m);
  std::vector<Vec3> places;
  for (int k = 0; k < options.directions; ++k) {
    const Vec3 along = spiral_direction(k, options.directions);
    const Vec3 right = unit(std::abs(along.z) < 0.9 ? cross(along, {0.0, 0.0, 1.0})
                                                    : cross(along, {1.0, 0.0, 0.0})),
               up = cross(along, right);
    for (int ray = 0; ray < options.rays; ++ray) {
      const double x_m = across_m(random), y_m = across_m(random);
      const Vec3 from = middle - 2.0 * radius_m * along + x_m * right + y_m * up;
      const double depth_m = tree.first_hit(from, along);
      if (!std::isfinite(depth_m)) continue;
      // A slanted face is met earlier beside the ray too.
      constexpr double kSlant = 8.0;
      const std::array beside{right, up, -right, -up};
      const bool is_through_gap =
          options.beside_m > 0.0 && std::any_of(beside.begin(), beside.end(), [&](Vec3 way) {
            return tree.first_hit(from + options.beside_m * way, along) < depth_m - kSlant * options.beside_m;
          });
      if (!is_through_gap) places.push_back(from + depth_m * along);
    }
  }
  return places;
}

}  // namespace palpable::sculpt
