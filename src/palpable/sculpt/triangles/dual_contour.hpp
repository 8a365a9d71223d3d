// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_surface.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <functional>
#include <span>

namespace palpable::sculpt {

/// A solid as a function: negative inside, with a gradient. With a gradient of 0, for solids whose edges
/// need not be sharp, each vertex is the mean of its edge crossings. Any thread.
using SolidFunction = std::function<models::FieldSample(Vec3 place_m)>;

struct DualContourOptions {
  /// Side of the cubes that hold one vertex each, > 0.
  double spacing_m = 0.0;
};

/// The surface where `solid` is 0, as triangles facing outwards: one vertex for each sheet of it in each
/// cube, where the tangent planes of its crossings meet, so that edges and corners stay sharp (dual
/// contouring, Ju et al. 2002). Begins at `seeds_m`, places on or near the surface, and follows it from cube
/// to cube within `bounds`; where it leaves them it is left open. Errors: usage for a spacing that makes over
/// 2^19 cubes along a side; interrupted.
Result<Mesh> dual_contour(const SolidFunction& solid, const Box& bounds, std::span<const Vec3> seeds_m,
                          const DualContourOptions& options, const Work& work);

}  // namespace palpable::sculpt
