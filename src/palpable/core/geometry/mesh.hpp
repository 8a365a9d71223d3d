// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable {

/// A triangle mesh. Triangles are triples of vertex indices, counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Texture coordinates per vertex in the picture (0, 0 is top left, 1, 1 is bottom right); empty, or one
  /// per vertex.
  std::vector<std::array<float, 2>> picture_places;
};

/// Whether the mesh encloses a volume: every edge is used by exactly two triangles, once in each direction,
/// and no triangle repeats a vertex or refers to one that does not exist.
bool is_watertight(const Mesh& mesh);

/// A unit normal for each vertex: the mean of its triangles' normals, weighted by area; (0, 0, 1) where no
/// triangle determines it. The triangles must refer to vertices that exist.
std::vector<Vec3> vertex_normals(const Mesh& mesh);

}  // namespace palpable
