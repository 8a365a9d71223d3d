// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::sculpt {

/// A mesh some of whose edges were divided.
struct DividedMesh {
  Mesh mesh;
  /// For each triangle the one that it is a part of.
  std::vector<std::uint32_t> part_of;
};

/// Divides edges where rims touch them without a common vertex: rim edges at vertices of other triangles that
/// lie on them, and edges of other triangles at vertices of rims. A rim is an edge of an odd number of
/// triangles. Where surfaces meet along lines that are divided differently, such as a box against a wall,
/// they share edges afterwards. No vertices are added; places within `touching_m` coincide. The mesh must be
/// welded. nullopt if nothing is divided, as in a single surface without edges of three triangles.
std::optional<DividedMesh> divide_touching_edges(const Mesh& mesh, double touching_m);

}  // namespace palpable::sculpt
