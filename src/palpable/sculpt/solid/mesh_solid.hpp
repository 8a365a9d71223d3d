// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace palpable::sculpt {

/// What was found and mended in a mesh on its way to a solid.
struct MeshRepair {
  std::size_t triangles = 0;
  /// Triangles without an area, or with a vertex that is not finite or not there: left out.
  std::size_t degenerate = 0;
  /// Parts that were turned to face outwards.
  std::size_t turned_parts = 0;
  /// Rims that were closed by a fan of triangles.
  std::size_t closed_holes = 0;
  /// Triangles that have the solid on both of their sides, or on none: not part of its surface.
  std::size_t inner = 0;
  /// Facets that were taken for a smooth surface, and how far that lies beside them at most.
  std::size_t rounded = 0;
  double rounded_m = 0.0;
  /// One sentence each, for the person.
  std::vector<std::string> notes() const;
};

struct MeshSolid {
  std::unique_ptr<DistanceSource> distance;
  MeshRepair repair;
};

/// The solid that a mesh means, with its exact distance. A closed, outward mesh is taken as it is. Of others:
/// parts are turned to face outwards (by the parity of rays, as Takayama et al. 2014), holes closed, and the
/// solid is where the triangles wind round a place at least once (generalised winding number, Jacobson et al.
/// 2013); triangles inside the solid, where bodies overlap, are left out, and those that are partly inside
/// cut along the lines where others cross them, into pieces no smaller than `finest_m`. With `rounding_m`,
/// the facets of a mesh that is taken as it is are taken for the smooth surface that they stand for
/// (SmoothSurface) where it lies no farther beside them, and where they are so small that none of their
/// places is more than two finest cells from an edge. Errors: invalid_input for a mesh without triangles or
/// without a volume, interrupted.
Result<MeshSolid> solid_from_mesh(const Mesh& mesh, double finest_m, const Work& work,
                                  double rounding_m = 0.0);

/// An error where a mesh of so many triangles would take more than `free_bytes` on its way to a solid: with
/// what it would take, and how many triangles fit.
std::optional<Error> mesh_too_large(std::size_t triangles, std::size_t free_bytes);

/// The solid inside a surface that was contoured (dual_contour.hpp): its triangles face outwards and close,
/// though its sheets may touch, so nothing is mended. Errors: invalid_input for a mesh without triangles.
Result<std::unique_ptr<DistanceSource>> solid_from_contour(const Mesh& mesh);

}  // namespace palpable::sculpt
