// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>

namespace palpable::sculpt {

/// Four triangles in single precision, relative to an origin near them, whose distances are computed at
/// once: in each triangle's own plane, where every edge has its direction and length, so that no division is
/// left for a query. The error is a few units in the last place of the farthest coordinate. Slivers are as
/// accurate, since all directions come from double precision.
class FourTriangles {
 public:
  static constexpr std::size_t kCount = 4;
  using Distances = std::array<float, kCount>;

  /// All corners from the origin. The triangle has an area.
  void set(std::size_t lane, const std::array<Vec3, 3>& corners) {
    const Vec3 ab = corners[1] - corners[0], ac = corners[2] - corners[0];
    const Vec3 normal = unit(cross(ab, ac)), along = unit(ab), across = cross(normal, along);
    put(corner_, lane, corners[0]);
    put(along_, lane, along);
    put(across_, lane, across);
    put(normal_, lane, normal);
    const std::array<std::array<double, 2>, 3> places{
        {{0.0, 0.0}, {norm(ab), 0.0}, {dot(ac, along), dot(ac, across)}}};
    for (std::size_t k = 0; k < 3; ++k) put(edges_[k], lane, places[k], places[(k + 1) % 3]);
  }

  Distances squared_distances(const std::array<float, 3>& p) const {
    const Triple way{p[0] - corner_[0], p[1] - corner_[1], p[2] - corner_[2]};
    const Four x = dot3(way, along_), y = dot3(way, across_), height = dot3(way, normal_);
    const BesideEdge a = beside(edges_[0], x, y), b = beside(edges_[1], x, y), c = beside(edges_[2], x, y);
    // Over the face where it lies to the left of all edges.
    const Four least_left = smaller(a.left, smaller(b.left, c.left));
    const Four to_edges = smaller(a.squared, smaller(b.squared, c.squared));
    return std::bit_cast<Distances>(height * height + (least_left >= Four{} ? Four{} : to_edges));
  }

 private:
  /// Of GCC and Clang: one register, every operation on all four.
  using Four = float __attribute__((vector_size(kCount * sizeof(float))));
  using Triple = std::array<Four, 3>;

  /// Edges in the triangles' planes: where they begin, their directions and lengths.
  struct Edge {
    Four x, y, along_x, along_y, length;
  };
  /// Places beside an edge: how far to its left, and the squared distance from it.
  struct BesideEdge {
    Four left, squared;
  };

  static void put(Triple& t, std::size_t lane, Vec3 v) {
    t[0][lane] = static_cast<float>(v.x);
    t[1][lane] = static_cast<float>(v.y);
    t[2][lane] = static_cast<float>(v.z);
  }
  static void put(Edge& edge, std::size_t lane, const std::array<double, 2>& from,
                  const std::array<double, 2>& to) {
    const double x = to[0] - from[0], y = to[1] - from[1], length = std::hypot(x, y);
    edge.x[lane] = static_cast<float>(from[0]);
    edge.y[lane] = static_cast<float>(from[1]);
    // An edge without a length counts as its corner, whatever its direction.
    edge.along_x[lane] = static_cast<float>(length > 0.0 ? x / length : 1.0);
    edge.along_y[lane] = static_cast<float>(length > 0.0 ? y / length : 0.0);
    edge.length[lane] = static_cast<float>(length);
  }
  static Four smaller(Four a, Four b) { return a < b ? a : b; }
  static Four larger(Four a, Four b) { return a < b ? b : a; }
  static Four dot3(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static BesideEdge beside(const Edge& edge, Four x, Four y) {
    const Four from_x = x - edge.x, from_y = y - edge.y;
    const Four along = edge.along_x * from_x + edge.along_y * from_y,
               left = edge.along_x * from_y - edge.along_y * from_x;
    const Four beyond = along - smaller(larger(along, Four{}), edge.length);
    return {left, beyond * beyond + left * left};
  }

  /// The first corner, and the plane's directions: along the first edge, across it, and the normal.
  Triple corner_{}, along_{}, across_{}, normal_{};
  std::array<Edge, 3> edges_{};
};

}  // namespace palpable::sculpt
