// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <utility>
#include <vector>

namespace palpable::sculpt {

/// A hash grid for range queries over points. Immutable; any thread. The points (finite) must outlive it.
class PointIndex {
 public:
  PointIndex(std::span<const Vec3> places_m, double cube_m) : places_(places_m), cube_m_(cube_m) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> sorted;
    sorted.reserve(places_.size());
    for (std::uint32_t i = 0; i < places_.size(); ++i) sorted.emplace_back(key(cell(places_[i])), i);
    std::sort(sorted.begin(), sorted.end());
    order_.reserve(sorted.size());
    for (const auto& [cube, i] : sorted) {
      auto& run = runs_.try_emplace(cube, order_.size(), std::size_t{0}).first->second;
      ++run.second;
      order_.push_back(i);
    }
  }

  /// Calls visit(index) for every point in the box, and for some outside it.
  template <class Visit>
  void in_box(Vec3 least_m, Vec3 most_m, Visit&& visit) const {
    const Cell low = cell(least_m), high = cell(most_m);
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
      for (std::int64_t y = low[1]; y <= high[1]; ++y)
        for (std::int64_t x = low[0]; x <= high[0]; ++x) {
          const auto run = runs_.find(key({x, y, z}));
          if (run == runs_.end()) continue;
          for (std::size_t k = 0; k < run->second.second; ++k) visit(order_[run->second.first + k]);
        }
  }

  /// Calls visit(index, squared distance) for every point within `radius_m` of `p`.
  template <class Visit>
  void within(Vec3 p, double radius_m, Visit&& visit) const {
    const Vec3 reach{radius_m, radius_m, radius_m};
    in_box(p - reach, p + reach, [&](std::uint32_t i) {
      const double squared = squared_norm(places_[i] - p);
      if (squared <= radius_m * radius_m) visit(i, squared);
    });
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cell(Vec3 p) const {
    return {static_cast<std::int64_t>(std::floor(p.x / cube_m_)),
            static_cast<std::int64_t>(std::floor(p.y / cube_m_)),
            static_cast<std::int64_t>(std::floor(p.z / cube_m_))};
  }
  /// Distant cubes may share a key, so visitors must compare the points themselves.
  static std::uint64_t key(Cell c) {
    const auto bits = [](std::int64_t v) { return static_cast<std::uint64_t>(v) & 0x1FFFFFU; };
    return bits(c[2]) << 42U | bits(c[1]) << 21U | bits(c[0]);
  }

  std::span<const Vec3> places_;
  double cube_m_;
  std::vector<std::uint32_t> order_;
  std::unordered_map<std::uint64_t, std::pair<std::size_t, std::size_t>> runs_;
};

}  // namespace palpable::sculpt
