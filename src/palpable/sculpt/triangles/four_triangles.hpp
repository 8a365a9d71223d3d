// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <bit>
#include <cstddef>

namespace palpable::sculpt {

/// Four triangles in single precision, relative to an origin near them, whose distances are computed at
/// once. The error is a few units in the last place of the farthest coordinate. Slivers are as accurate,
/// since the normals come from double precision.
class FourTriangles {
 public:
  static constexpr std::size_t kCount = 4;
  using Distances = std::array<float, kCount>;

  /// All corners from the origin. The triangle has an area.
  void set(std::size_t lane, const std::array<Vec3, 3>& corners) {
    for (std::size_t k = 0; k < 3; ++k) put(corners_[k], lane, corners[k]);
    put(normal_, lane, unit(cross(corners[1] - corners[0], corners[2] - corners[0])));
  }

  Distances squared_distances(const std::array<float, 3>& p) const {
    const Triple a = from(corners_[0], p), b = from(corners_[1], p), c = from(corners_[2], p);
    const Triple ab = minus(corners_[1], corners_[0]), bc = minus(corners_[2], corners_[1]),
                 ca = minus(corners_[0], corners_[2]);
    // Over the face where it lies to the left of all edges.
    const Four least = smaller(dot3(cross3(ab, a), normal_),
                               smaller(dot3(cross3(bc, b), normal_), dot3(cross3(ca, c), normal_)));
    const Four height = dot3(a, normal_);
    const Four to_edges = smaller(to_edge(ab, a), smaller(to_edge(bc, b), to_edge(ca, c)));
    return std::bit_cast<Distances>(least >= Four{} ? height * height : to_edges);
  }

 private:
  /// Of GCC and Clang: one register, every operation on all four.
  using Four = float __attribute__((vector_size(kCount * sizeof(float))));
  using Triple = std::array<Four, 3>;

  static void put(Triple& t, std::size_t lane, Vec3 v) {
    t[0][lane] = static_cast<float>(v.x);
    t[1][lane] = static_cast<float>(v.y);
    t[2][lane] = static_cast<float>(v.z);
  }
  static Four smaller(Four a, Four b) { return a < b ? a : b; }
  static Four larger(Four a, Four b) { return a < b ? b : a; }
  static Triple minus(const Triple& a, const Triple& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
  static Triple from(const Triple& corner, const std::array<float, 3>& p) {
    return {p[0] - corner[0], p[1] - corner[1], p[2] - corner[2]};
  }
  static Four dot3(const Triple& a, const Triple& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
  static Triple cross3(const Triple& a, const Triple& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  }
  static Four to_edge(const Triple& edge, const Triple& way) {
    // An edge shorter than single precision resolves counts as its corner.
    constexpr float kLeast = 1e-30F;
    const Four length2 = larger(dot3(edge, edge), Four{kLeast, kLeast, kLeast, kLeast});
    const Four one{1.0F, 1.0F, 1.0F, 1.0F};
    const Four along = smaller(larger(dot3(edge, way) / length2, Four{}), one);
    const Triple rest{way[0] - along * edge[0], way[1] - along * edge[1], way[2] - along * edge[2]};
    return dot3(rest, rest);
  }

  std::array<Triple, 3> corners_{};
  Triple normal_{};
};

}  // namespace palpable::sculpt
