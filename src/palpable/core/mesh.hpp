// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace palpable {

/// A surface of triangles. Corners counter-clockwise seen from outside, as indices of the vertices.
struct Mesh {
  std::vector<Vec3> vertices_m;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  /// Place in the picture per vertex (0, 0 top-left ... 1, 1 bottom-right); empty, or as many as the
  /// vertices.
  std::vector<std::array<float, 2>> picture_places;
};

/// Whether the mesh closes a volume: every edge is used by exactly two triangles, once in each direction, and
/// no triangle names a vertex twice or one that does not exist.
bool is_watertight(const Mesh& mesh);

}  // namespace palpable
