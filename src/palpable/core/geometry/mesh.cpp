// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/geometry/mesh.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace palpable {

bool is_watertight(const Mesh& mesh) {
  if (mesh.triangles.empty()) return false;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.triangles.size());
  for (const auto& t : mesh.triangles)
    for (std::size_t k = 0; k < 3; ++k) {
      if (t[k] >= mesh.vertices_m.size() || t[k] == t[(k + 1) % 3]) return false;
      edges.emplace_back(t[k], t[(k + 1) % 3]);
    }
  std::sort(edges.begin(), edges.end());
  if (std::adjacent_find(edges.begin(), edges.end()) != edges.end()) return false;
  return std::all_of(edges.begin(), edges.end(), [&edges](const auto& e) {
    return std::binary_search(edges.begin(), edges.end(), std::pair(e.second, e.first));
  });
}

std::vector<Vec3> vertex_normals(const Mesh& mesh) {
  std::vector<Vec3> normals(mesh.vertices_m.size());
  for (const auto& t : mesh.triangles) {
    const Vec3 a = mesh.vertices_m[t[0]];
    const Vec3 doubled_area = cross(mesh.vertices_m[t[1]] - a, mesh.vertices_m[t[2]] - a);
    for (const std::uint32_t k : t) normals[k] += doubled_area;
  }
  for (Vec3& n : normals) n = squared_norm(n) > 0.0 ? unit(n) : Vec3{0, 0, 1};
  return normals;
}

}  // namespace palpable
