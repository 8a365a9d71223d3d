// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <vector>

namespace palpable::sculpt {

/// The closed surface of the union of superquadrics, as samples to be corrected (correct_surface()).
struct ShapesSurface {
  Mesh mesh;
  /// Spacing of the samples, metres: the one asked for, or up to a third more.
  double spacing_m = 0.0;
};

/// Contours the union of `shapes`, at least one, with samples `spacing_m` > 0 apart, facing outwards. Shapes
/// thinner than `least_thickness_spacings` spacings, which would be lost between samples, are thickened. The
/// surface may be open where three sheets meet in one cube (dual_contour.hpp).
/// Errors: as distance_of() and dual_contour().
Result<Mesh> surface_of_shapes(const std::vector<models::Superquadric>& shapes, double spacing_m,
                               double least_thickness_spacings, const Work& work);

/// The same, closed: where the surface is open, it is contoured with coarser cubes. Errors: also as
/// predicted_surface(), if the last of them is open too.
Result<ShapesSurface> closed_surface_of_shapes(const std::vector<models::Superquadric>& shapes,
                                               double spacing_m, double least_thickness_spacings,
                                               const Work& work);

}  // namespace palpable::sculpt
