// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/triangles/pinched_edges.hpp"

#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/sculpt/triangles/mesh_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

// A side of a triangle, by its vertices in ascending order.
struct Side {
  std::uint32_t low = 0, high = 0, triangle = 0;
  // The corner at which the side begins, 0 … 2.
  std::uint8_t corner = 0;
  bool ascends = true;
};

// Corners of triangles are numbered 3 triangle + corner.
std::uint32_t corner_of(const Side& side, bool at_low) {
  return 3 * side.triangle + (side.ascends == at_low ? side.corner : (side.corner + 1U) % 3U);
}

// The angle about an edge from one triangle to another, through the solid behind the first.
double angle_through_solid(const Mesh& mesh, const Side& from, const Side& to) {
  const Vec3 a = mesh.vertices_m[from.low], axis = unit(mesh.vertices_m[from.high] - a);
  const auto away = [&](const Side& side) {
    const Vec3 third = mesh.vertices_m[mesh.triangles[side.triangle][(side.corner + 2U) % 3U]] - a;
    return third - dot(third, axis) * axis;
  };
  const Vec3 x = unit(away(from));
  // Seen along the edge's own direction in `from`, the triangle lies to the left of it and faces up.
  const Vec3 outwards = from.ascends ? cross(axis, x) : cross(x, axis);
  const Vec3 other = away(to);
  const double angle = std::atan2(-dot(other, outwards), dot(other, x));
  return angle > 0.0 ? angle : angle + 2.0 * std::numbers::pi;
}

void join_at(const Side& a, const Side& b, DisjointSets& corners) {
  for (const bool at_low : {true, false}) corners.join(corner_of(a, at_low), corner_of(b, at_low));
}

// The sides at one edge in pairs that bound the same part of the solid: those next to each other through it.
// Sides without a partner are left out.
std::vector<std::pair<Side, Side>> pairs_around(const Mesh& mesh, std::span<const Side> around) {
  if (around.size() == 2) return {{around[0], around[1]}};
  std::vector<std::tuple<double, const Side*, const Side*>> possible;
  for (const Side& from : around)
    for (const Side& to : around)
      if (from.ascends && !to.ascends) possible.emplace_back(angle_through_solid(mesh, from, to), &from, &to);
  std::sort(possible.begin(), possible.end());
  std::vector<std::pair<Side, Side>> pairs;
  std::vector<const Side*> taken;
  const auto is_taken = [&](const Side* side) {
    return std::find(taken.begin(), taken.end(), side) != taken.end();
  };
  for (const auto& [angle, from, to] : possible) {
    if (is_taken(from) || is_taken(to)) continue;
    pairs.emplace_back(*from, *to);
    taken.insert(taken.end(), {from, to});
  }
  return pairs;
}

// Calls `visit` with the sides at each edge.
template <class Visit>
void for_each_edge(const Mesh& mesh, Visit visit) {
  std::vector<Side> sides;
  sides.reserve(3 * mesh.triangles.size());
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint8_t k = 0; k < 3; ++k) {
      const std::uint32_t a = mesh.triangles[t][k], b = mesh.triangles[t][(k + 1U) % 3U];
      sides.push_back({std::min(a, b), std::max(a, b), t, k, a < b});
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle, a.corner) < std::tie(b.low, b.high, b.triangle, b.corner);
  });
  for (auto begin = sides.cbegin(); begin != sides.cend();) {
    const auto end = std::find_if(begin, sides.cend(), [&](const Side& side) {
      return side.low != begin->low || side.high != begin->high;
    });
    visit(std::span<const Side>(begin, end));
    begin = end;
  }
}

constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// Divides the vertices where the triangles around them are not connected across edges.
Mesh with_vertices_divided(const Mesh& mesh) {
  DisjointSets corners(3 * mesh.triangles.size());
  for_each_edge(mesh, [&](std::span<const Side> around) {
    for (const auto& [a, b] : pairs_around(mesh, around)) join_at(a, b, corners);
  });
  Mesh out;
  out.triangles.resize(mesh.triangles.size());
  std::vector<std::uint32_t> vertex(3 * mesh.triangles.size(), kNone);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::uint32_t k = 0; k < 3; ++k) {
      std::uint32_t& at = vertex[corners.find(3 * t + k)];
      if (at == kNone) {
        at = static_cast<std::uint32_t>(out.vertices_m.size());
        out.vertices_m.push_back(mesh.vertices_m[mesh.triangles[t][k]]);
      }
      out.triangles[t][k] = at;
    }
  return out;
}

// A triangle whose sides have vertices in their middles (or kNone), as triangles without other ones there.
void add_divided(const std::array<std::uint32_t, 3>& t, const std::array<std::uint32_t, 3>& middles,
                 std::vector<std::array<std::uint32_t, 3>>& out) {
  const auto first = std::find_if(middles.begin(), middles.end(), [](auto m) { return m != kNone; });
  if (first == middles.end()) {
    out.push_back(t);
    return;
  }
  // A fan around one of these vertices: it is on no line with two neighbours of its outline but its own
  // side's.
  const auto k = static_cast<std::size_t>(first - middles.begin());
  std::vector<std::uint32_t> outline;
  for (std::size_t i = 1; i <= 3; ++i) {
    outline.push_back(t[(k + i) % 3]);
    if (i < 3 && middles[(k + i) % 3] != kNone) outline.push_back(middles[(k + i) % 3]);
  }
  for (std::size_t i = 1; i < outline.size(); ++i) out.push_back({*first, outline[i - 1], outline[i]});
}

// At edges of several pairs of triangles, whose sheets are connected around the ends, each pair gets a vertex
// of its own in the middle.
Mesh with_edges_divided(Mesh mesh) {
  std::vector<std::array<std::uint32_t, 3>> middles(mesh.triangles.size(), {kNone, kNone, kNone});
  for_each_edge(mesh, [&](std::span<const Side> around) {
    if (around.size() <= 2) return;
    for (const auto& [a, b] : pairs_around(mesh, around)) {
      const auto middle = static_cast<std::uint32_t>(mesh.vertices_m.size());
      mesh.vertices_m.push_back(0.5 * (mesh.vertices_m[a.low] + mesh.vertices_m[a.high]));
      middles[a.triangle][a.corner] = middles[b.triangle][b.corner] = middle;
    }
  });
  std::vector<std::array<std::uint32_t, 3>> triangles;
  triangles.reserve(mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    add_divided(mesh.triangles[t], middles[t], triangles);
  mesh.triangles = std::move(triangles);
  return mesh;
}

}  // namespace

Mesh with_pinches_divided(const Mesh& mesh) { return with_edges_divided(with_vertices_divided(mesh)); }

}  // namespace palpable::sculpt
