// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// What the tests of solids share: a ball that knows its distance, and a box as a mesh.

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <algorithm>

namespace palpable::sculpt {

class Ball final : public DistanceSource {
 public:
  explicit Ball(double radius_m) : radius_m_(radius_m) {}
  models::DistanceSample at(Vec3 p, Hint&) const override {
    return {norm(p) - radius_m_, norm(p) > 0.0 ? unit(p) : Vec3{1.0, 0.0, 0.0}};
  }
  Box bounds() const override {
    return {{-radius_m_, -radius_m_, -radius_m_}, {radius_m_, radius_m_, radius_m_}};
  }

 private:
  double radius_m_;
};

inline Mesh box_mesh(Vec3 low, Vec3 high) {
  Mesh mesh;
  for (unsigned i = 0; i < 8; ++i)
    mesh.vertices_m.push_back({i & 1U ? high.x : low.x, i & 2U ? high.y : low.y, i & 4U ? high.z : low.z});
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

inline double box_distance(Vec3 p, Vec3 low, Vec3 high) {
  const Vec3 d{std::max(low.x - p.x, p.x - high.x), std::max(low.y - p.y, p.y - high.y),
               std::max(low.z - p.z, p.z - high.z)};
  const double inside = std::max({d.x, d.y, d.z});
  return inside < 0.0 ? inside : norm({std::max(d.x, 0.0), std::max(d.y, 0.0), std::max(d.z, 0.0)});
}

/// Both in one mesh.
inline Mesh together(Mesh a, const Mesh& b) {
  const auto first = static_cast<std::uint32_t>(a.vertices_m.size());
  for (auto t : b.triangles) {
    for (auto& v : t) v += first;
    a.triangles.push_back(t);
  }
  a.vertices_m.insert(a.vertices_m.end(), b.vertices_m.begin(), b.vertices_m.end());
  return a;
}

}  // namespace palpable::sculpt
