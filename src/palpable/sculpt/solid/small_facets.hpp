// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/vec3.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace palpable::sculpt {

/// Neighbouring facets whose normals differ by more than 20 degrees meet in a sharp edge: cosine of that
/// angle.
inline constexpr double kSmoothCosine = 0.9397;

/// The radius of the greatest circle in a triangle.
inline double inradius_m(const std::array<Vec3, 3>& t) {
  const double around_m = norm(t[1] - t[0]) + norm(t[2] - t[1]) + norm(t[0] - t[2]);
  return norm(cross(t[1] - t[0], t[2] - t[0])) / around_m;
}

/// The height of a uniformly curved surface above two triangles that turn by `turn` over a common edge: h
/// turn / 3 above the centre of equilateral ones, h turn / 8 for long strips.
inline double bulge_over_edge_m(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double edge_m,
                                double turn) {
  const auto height_m = [&](const std::array<Vec3, 3>& t) {
    return norm(cross(t[1] - t[0], t[2] - t[0])) / edge_m;
  };
  return std::max(height_m(a), height_m(b)) * turn / 3.0;
}

/// Which edges are those between small facets of a curved surface.
struct SmallFacets {
  /// Greatest distance of the curved surface from the facets.
  double most_m = std::numeric_limits<double>::infinity();
  /// Facets with a larger inscribed circle are the mesh's own shape, however small their angles.
  double largest_facet_m = std::numeric_limits<double>::infinity();
};

/// How far a curved surface may be from one of its facets: distance, and angle in radians. 0 for facets that
/// are the mesh's own shape.
struct FacetTolerance {
  float rise_m = 0.0F, turn = 0.0F;
};

/// The greatest rise and turn over each triangle's edges that have one more triangle, turned the same way.
/// Triangles that were cut have other edges too, which do not count. Linear in the number of triangles.
std::vector<FacetTolerance> facet_tolerances(const Mesh& mesh, const SmallFacets& small);

}  // namespace palpable::sculpt
