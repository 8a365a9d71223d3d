// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

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

/// Which edges are divided: rims at vertices of rims alone, which joins faces that form one surface but for
/// slits without a width; or also rims at vertices of other triangles, and other edges at vertices of rims.
enum class TouchingEdges { rims, all };

/// Divides edges where rims touch them without a common vertex. A rim is an edge of an odd number of
/// triangles. Where surfaces meet along lines that are divided differently, such as a box against a wall,
/// they share edges afterwards. No vertices are added; places within `touching_m` coincide. The mesh must be
/// welded. nullopt if nothing is divided, as with `all` in a single surface without edges of three triangles.
std::optional<DividedMesh> divide_touching_edges(const Mesh& mesh, double touching_m, TouchingEdges which);

}  // namespace palpable::sculpt
