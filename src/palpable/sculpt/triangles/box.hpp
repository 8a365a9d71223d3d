// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <span>

namespace palpable::sculpt {

/// An axis-parallel box, metres.
struct Box {
  Vec3 least_m;
  Vec3 most_m;

  Vec3 size_m() const { return most_m - least_m; }
  void grow(Vec3 p) {
    least_m = {std::min(least_m.x, p.x), std::min(least_m.y, p.y), std::min(least_m.z, p.z)};
    most_m = {std::max(most_m.x, p.x), std::max(most_m.y, p.y), std::max(most_m.z, p.z)};
  }
};

/// The bounding box of at least one point.
inline Box bounds_of(std::span<const Vec3> places_m) {
  Box box{places_m.front(), places_m.front()};
  for (const Vec3 p : places_m) box.grow(p);
  return box;
}

/// The bounding box of a mesh's triangles, of which there is at least one.
inline Box bounds_of(const Mesh& mesh) {
  const Vec3 first = mesh.vertices_m[mesh.triangles[0][0]];
  Box box{first, first};
  for (const auto& t : mesh.triangles)
    for (const std::uint32_t index : t) box.grow(mesh.vertices_m[index]);
  return box;
}

}  // namespace palpable::sculpt
