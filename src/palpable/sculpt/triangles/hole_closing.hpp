// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace palpable::sculpt {

/// A hole in a surface. Its rim is a loop of edges with more triangles in one direction than in the other,
/// so that a wall that bodies share is no hole.
struct Hole {
  struct RimEdge {
    std::uint32_t from = 0, to = 0;
    /// The triangle that the edge belongs to.
    std::uint32_t triangle = 0;
  };
  std::vector<RimEdge> rim;
  /// The triangles that close it, between the vertices of its rim (triangulated_hole()); at least one.
  std::vector<std::array<std::uint32_t, 3>> lid;
};

/// The holes of the surface that these triangles form. Triangles that are not connected across edges have
/// holes of their own, though they may share vertices.
std::vector<Hole> holes_of(std::span<const Vec3> vertices_m,
                           std::span<const std::array<std::uint32_t, 3>> triangles);

/// Appends the lids of a mesh's holes. Returns their number.
std::size_t add_lids(Mesh& mesh, std::span<const Hole> holes);

/// The same with all holes of the mesh.
std::size_t close_holes(Mesh& mesh);

/// Triangles that close a hole without new vertices, as indices into its rim: of all triangulations without a
/// fold (neighbours that turn by more than 120 degrees; where each has one, those with the least) that of
/// least area (Barequet & Sharir 1995; folds as in Liepa 2003). A flat rim gets a flat lid, whatever its
/// outline. `rim`: at least three places in the order of the surface's own edges; `normals`: of the surface's
/// triangle at the edge from place i to the next one, or zero where it does not matter. A rim of more than
/// 256 places is divided by its shortest chord first. Triangles without an area are left out.
std::vector<std::array<std::uint32_t, 3>> triangulated_hole(std::span<const Vec3> rim,
                                                            std::span<const Vec3> normals);

}  // namespace palpable::sculpt
