// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

#include <algorithm>
#include <array>
#include <map>

// Meshes of tests.
namespace palpable::sculpt {

/// Adds a box whose corners are shared with equal ones of the mesh.
inline void add_joined_box(Vec3 least, Vec3 most, Mesh& mesh) {
  std::array<std::uint32_t, 8> at{};
  for (unsigned i = 0; i < 8; ++i) {
    const Vec3 p{(i & 1U) != 0 ? most.x : least.x, (i & 2U) != 0 ? most.y : least.y,
                 (i & 4U) != 0 ? most.z : least.z};
    at[i] = static_cast<std::uint32_t>(mesh.vertices_m.size());
    for (std::uint32_t k = 0; k < mesh.vertices_m.size(); ++k)
      if (mesh.vertices_m[k] == p) at[i] = k;
    if (at[i] == mesh.vertices_m.size()) mesh.vertices_m.push_back(p);
  }
  constexpr std::array<std::array<std::size_t, 4>, 6> kFaces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : kFaces) {
    mesh.triangles.push_back({at[f[0]], at[f[1]], at[f[2]]});
    mesh.triangles.push_back({at[f[0]], at[f[2]], at[f[3]]});
  }
}

/// Two towers of 1 m that touch along the edge x = y = 1 stand on one plate and carry another: around both
/// ends of the edge their walls are connected. Its volume is 10 m3.
inline Mesh touching_towers() {
  Mesh mesh;
  add_joined_box({0, 0, 0}, {1, 1, 1}, mesh);
  add_joined_box({1, 1, 0}, {2, 2, 1}, mesh);
  for (const double z : {-1.0, 1.0})
    for (const double x : {0.0, 1.0})
      for (const double y : {0.0, 1.0}) add_joined_box({x, y, z}, {x + 1, y + 1, z + 1}, mesh);
  // Walls between boxes are there twice, in opposite directions.
  const auto corners_of_wall = [&](std::size_t first) {
    std::array<std::uint32_t, 4> at{};
    std::copy(mesh.triangles[first].begin(), mesh.triangles[first].end(), at.begin());
    at[3] = mesh.triangles[first + 1][2];
    std::sort(at.begin(), at.end());
    return at;
  };
  std::map<std::array<std::uint32_t, 4>, int> walls;
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2) ++walls[corners_of_wall(i)];
  Mesh solid{mesh.vertices_m, {}, {}};
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 2)
    if (walls[corners_of_wall(i)] == 1)
      solid.triangles.insert(solid.triangles.end(), {mesh.triangles[i], mesh.triangles[i + 1]});
  return solid;
}

}  // namespace palpable::sculpt
