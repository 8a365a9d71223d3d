// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/correction/surface_geodesic.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::sculpt {

SampleNetwork network_of(const Mesh& mesh) {
  SampleNetwork n;
  n.normals.resize(mesh.vertices_m.size());
  n.begin.resize(mesh.vertices_m.size() + 1);
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 twice = cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    for (const std::uint32_t i : t) {
      n.normals[i] += twice;
      // In a closed mesh each edge occurs once in each direction.
      ++n.begin[i + 1];
    }
  }
  for (Vec3& normal : n.normals) normal = unit(normal);
  for (std::size_t i = 1; i < n.begin.size(); ++i) n.begin[i] += n.begin[i - 1];
  n.edges.resize(3 * mesh.triangles.size());
  std::vector<std::uint32_t> next(n.begin.begin(), n.begin.end() - 1);
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      n.edges[next[a]++] = {b, norm(mesh.vertices_m[b] - mesh.vertices_m[a])};
    }
  return n;
}

double Geodesic::distance_m(std::uint32_t a, std::uint32_t b) const {
  const double chord = norm(places_m_[a] - places_m_[b]);
  const double half_sine = 0.5 * norm(network_.normals[a] - network_.normals[b]);
  return half_sine > 1e-6 ? chord * std::asin(std::min(half_sine, 1.0)) / half_sine : chord;
}

}  // namespace palpable::sculpt
