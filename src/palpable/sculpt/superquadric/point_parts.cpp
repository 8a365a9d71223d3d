// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/point_parts.hpp"

#include "palpable/sculpt/points/point_index.hpp"
#include "palpable/sculpt/superquadric/superquadric_starts.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <utility>

namespace palpable::sculpt {

Members thinned(std::span<const Vec3> points, std::size_t most) {
  Members all(points.size());
  std::iota(all.begin(), all.end(), 0U);
  if (points.size() <= most) return all;
  const Box box = bounds_of(points);
  const Vec3 size = box.size_m();
  double cell_m = std::max({size.x, size.y, size.z}) / 256.0;
  for (;; cell_m *= 1.25) {
    std::map<std::array<int, 3>, std::uint32_t> first;
    for (const std::uint32_t i : all) {
      const Vec3 p = (points[i] - box.least_m) / cell_m;
      first.try_emplace({static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z)}, i);
    }
    if (first.size() > most) continue;
    Members some;
    for (const auto& [cell, i] : first) some.push_back(i);
    std::sort(some.begin(), some.end());
    return some;
  }
}

std::vector<Members> pieces_of(std::span<const Vec3> points, const Members& members, double gap_m) {
  std::vector<Vec3> places;
  for (const std::uint32_t i : members) places.push_back(points[i]);
  const PointIndex near(places, gap_m);
  std::vector<std::uint8_t> taken(members.size(), 0);
  std::vector<Members> pieces;
  for (std::uint32_t seed = 0; seed < members.size(); ++seed) {
    if (taken[seed] != 0) continue;
    taken[seed] = 1;
    Members piece{seed};
    for (std::size_t k = 0; k < piece.size(); ++k)
      near.within(places[piece[k]], gap_m, [&](std::uint32_t i, double) {
        if (taken[i] == 0) taken[i] = 1, piece.push_back(i);
      });
    for (std::uint32_t& i : piece) i = members[i];
    std::sort(piece.begin(), piece.end());
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::array<Members, 2> halved(std::span<const Vec3> points, const Members& members) {
  const auto farthest = [&](Vec3 from) {
    return points[*std::max_element(members.begin(), members.end(), [&](std::uint32_t a, std::uint32_t b) {
      return squared_norm(points[a] - from) < squared_norm(points[b] - from);
    })];
  };
  const Vec3 end = farthest(points[members.front()]);
  const Vec3 axis = unit(farthest(end) - end);
  std::vector<double> at;
  for (const std::uint32_t i : members) at.push_back(dot(axis, points[i]));
  const double middle = median_of(at);
  std::array<Members, 2> halves;
  for (std::size_t k = 0; k < members.size(); ++k) halves[at[k] < middle ? 0 : 1].push_back(members[k]);
  return halves;
}

}  // namespace palpable::sculpt
