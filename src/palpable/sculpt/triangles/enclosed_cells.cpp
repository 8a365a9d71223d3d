// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/enclosed_cells.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/sculpt/triangles/box.hpp"
#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace palpable::sculpt {
namespace {

/// Each triangle has two sides: 2 t is the front, 2 t + 1 the back.
std::uint32_t front_of(std::uint32_t triangle) { return 2 * triangle; }
std::uint32_t back_of(std::uint32_t triangle) { return 2 * triangle + 1; }

/// A triangle at an edge: the direction in which it leaves the edge, as an angle around it.
struct Leaf {
  double angle = 0.0;
  std::uint32_t triangle = 0;
  /// The side that faces increasing angles, and the other one.
  std::uint32_t ahead = 0, behind = 0;
};

Vec3 any_across(Vec3 along) {
  const Vec3 x = cross(along, {1.0, 0.0, 0.0}), y = cross(along, {0.0, 1.0, 0.0});
  return squared_norm(x) > squared_norm(y) ? x : y;
}

void join_sides_at(const Mesh& mesh, std::span<const EdgeUse> edge, DisjointSets& sides) {
  const auto low = static_cast<std::uint32_t>(edge.front().key >> 32U),
             high = static_cast<std::uint32_t>(edge.front().key);
  const Vec3 from = mesh.vertices_m[low], along = unit(mesh.vertices_m[high] - from);
  std::vector<Leaf> leaves;
  Vec3 first, second;
  for (const EdgeUse& use : edge) {
    Vec3 away;
    for (const std::uint32_t v : mesh.triangles[use.triangle])
      if (v != low && v != high) away = mesh.vertices_m[v] - from;
    away = away - dot(away, along) * along;
    // A triangle that is a line to rounding has no direction.
    if (!(squared_norm(away) > 0.0)) away = leaves.empty() ? any_across(along) : first;
    if (leaves.empty()) {
      first = unit(away);
      second = cross(along, first);
    }
    // A triangle that uses the edge in its direction has its front at increasing angles.
    const bool is_ahead = use.step > 0;
    leaves.push_back({leaves.empty() ? 0.0 : std::atan2(dot(away, second), dot(away, first)), use.triangle,
                      is_ahead ? front_of(use.triangle) : back_of(use.triangle),
                      is_ahead ? back_of(use.triangle) : front_of(use.triangle)});
  }
  std::sort(leaves.begin(), leaves.end(), [](const Leaf& a, const Leaf& b) {
    return std::pair(a.angle, a.triangle) < std::pair(b.angle, b.triangle);
  });
  for (std::size_t i = 0; i < leaves.size(); ++i)
    sides.join(leaves[i].ahead, leaves[(i + 1) % leaves.size()].behind);
}

/// What the sides of one surface enclose.
struct Shells {
  Vec3 origin_m;
  Box box;
  double area_m2 = 0.0;
  /// The volume around which each shell is wrapped: negative for a cell, seen from within.
  std::map<std::uint32_t, double> volumes_m3;
};

}  // namespace

std::vector<CellSide> find_enclosed_cells(Mesh& mesh, std::span<const char> is_examined) {
  const std::size_t count = mesh.triangles.size();
  std::vector<CellSide> found(count, CellSide::open);
  const std::vector<EdgeUse> uses = edge_uses(mesh.triangles);
  const std::vector<std::uint32_t> surface = connected_by_edges(count, uses);
  DisjointSets sides(2 * count);
  visit_edges(uses, [&](std::span<const EdgeUse> edge) {
    if (is_examined[edge.front().triangle] != 0) join_sides_at(mesh, edge, sides);
  });
  std::map<std::uint32_t, Shells> of_surface;
  for (std::uint32_t t = 0; t < count; ++t) {
    if (is_examined[t] == 0) continue;
    const auto& v = mesh.triangles[t];
    const std::array corners{mesh.vertices_m[v[0]], mesh.vertices_m[v[1]], mesh.vertices_m[v[2]]};
    const auto [at, is_new] = of_surface.try_emplace(surface[t]);
    Shells& shells = at->second;
    if (is_new) shells.origin_m = corners[0], shells.box = {corners[0], corners[0]};
    for (const Vec3 corner : corners) shells.box.grow(corner);
    const Vec3 a = corners[0] - shells.origin_m, b = corners[1] - shells.origin_m,
               c = corners[2] - shells.origin_m;
    const double volume_m3 = dot(a, cross(b, c)) / 6.0;
    shells.area_m2 += 0.5 * norm(cross(b - a, c - a));
    shells.volumes_m3[sides.find(front_of(t))] += volume_m3;
    shells.volumes_m3[sides.find(back_of(t))] -= volume_m3;
  }
  const auto encloses = [&](const Shells& shells, std::uint32_t side) {
    constexpr double kHardlyAny = 1e-6;
    return shells.volumes_m3.at(sides.find(side)) < -kHardlyAny * shells.area_m2 * norm(shells.box.size_m());
  };
  for (std::uint32_t t = 0; t < count; ++t) {
    if (is_examined[t] == 0) continue;
    const Shells& shells = of_surface.at(surface[t]);
    const bool front = !encloses(shells, front_of(t)), back = !encloses(shells, back_of(t));
    found[t] = front && back ? CellSide::open : front || back ? CellSide::boundary : CellSide::inner;
    if (!front && back) std::swap(mesh.triangles[t][1], mesh.triangles[t][2]);
  }
  return found;
}

}  // namespace palpable::sculpt
