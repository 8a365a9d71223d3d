// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/superquadric/point_parts.hpp"

#include "palpable/sculpt/points/point_index.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

namespace palpable::sculpt {
namespace {

/// The 13 directions to a cube's faces, edges and corners, one of each opposite pair.
std::vector<Vec3> half_of_the_directions() {
  std::vector<Vec3> directions;
  const auto step = [](int of_three) { return static_cast<double>(of_three % 3 - 1); };
  for (int k = 14; k < 27; ++k) {
    const int row = k / 3, layer = k / 9;
    directions.push_back(unit(Vec3{step(layer), step(row), step(k)}));
  }
  return directions;
}

}  // namespace

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

std::array<Members, 2> cut_at_neck(std::span<const Vec3> points, const Members& members, double width_m) {
  constexpr int kOffsets = 16;
  constexpr std::size_t kLeastShare = 8;
  double best = std::numeric_limits<double>::infinity();
  Vec3 best_axis;
  double best_offset_m = 0.0;
  std::vector<double> at(members.size());
  for (const Vec3 axis : half_of_the_directions()) {
    for (std::size_t k = 0; k < members.size(); ++k) at[k] = dot(axis, points[members[k]]);
    std::sort(at.begin(), at.end());
    const double first_m = at[at.size() / kLeastShare], last_m = at[at.size() - 1 - at.size() / kLeastShare];
    for (int k = 0; k <= kOffsets; ++k) {
      const double offset_m = first_m + (last_m - first_m) * k / kOffsets;
      const auto below = [&](double m) {
        return static_cast<double>(std::lower_bound(at.begin(), at.end(), m) - at.begin());
      };
      const double cut = below(offset_m + 0.5 * width_m) - below(offset_m - 0.5 * width_m);
      const double smaller = std::min(below(offset_m), static_cast<double>(at.size()) - below(offset_m));
      if (smaller < 1.0 || (cut + 1.0) / smaller >= best) continue;
      best = (cut + 1.0) / smaller, best_axis = axis, best_offset_m = offset_m;
    }
  }
  std::array<Members, 2> sides;
  for (const std::uint32_t i : members) sides[dot(best_axis, points[i]) < best_offset_m ? 0 : 1].push_back(i);
  return sides;
}

}  // namespace palpable::sculpt
