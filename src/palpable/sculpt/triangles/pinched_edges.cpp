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
#include <tuple>
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

void join_around(const Mesh& mesh, std::vector<Side>::const_iterator begin,
                 std::vector<Side>::const_iterator end, DisjointSets& corners) {
  if (end - begin == 2) {
    join_at(*begin, *(begin + 1), corners);
    return;
  }
  for (auto from = begin; from != end; ++from) {
    if (!from->ascends) continue;
    const Side* nearest = nullptr;
    double least = 0.0;
    for (auto to = begin; to != end; ++to) {
      if (to->ascends) continue;
      const double angle = angle_through_solid(mesh, *from, *to);
      if (nearest == nullptr || angle < least) nearest = &*to, least = angle;
    }
    if (nearest != nullptr) join_at(*from, *nearest, corners);
  }
}

}  // namespace

Mesh with_pinches_divided(const Mesh& mesh) {
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
  DisjointSets corners(sides.size());
  for (auto begin = sides.cbegin(); begin != sides.cend();) {
    const auto end = std::find_if(begin, sides.cend(), [&](const Side& side) {
      return side.low != begin->low || side.high != begin->high;
    });
    join_around(mesh, begin, end, corners);
    begin = end;
  }
  Mesh out;
  out.triangles.resize(mesh.triangles.size());
  constexpr std::uint32_t kNone = 0xFFFFFFFFU;
  std::vector<std::uint32_t> vertex(sides.size(), kNone);
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

}  // namespace palpable::sculpt
