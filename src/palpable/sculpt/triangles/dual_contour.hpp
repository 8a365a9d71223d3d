// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_sample.hpp"
#include "palpable/sculpt/triangles/box.hpp"

#include <functional>
#include <span>

namespace palpable::sculpt {

/// A solid as a function: negative inside, with a gradient. With a gradient of 0, for solids whose edges
/// need not be sharp, each vertex is the mean of its edge crossings. Any thread.
using SolidFunction = std::function<models::DistanceSample(Vec3 place_m)>;

struct DualContourOptions {
  /// Side of the cubes, with one vertex each, > 0.
  double spacing_m = 0.0;
};

/// The zero surface of `solid` as triangles facing outwards, by dual contouring (Ju et al. 2002): one vertex
/// for each sheet in each cube, at the intersection of the tangent planes of its crossings, so that edges and
/// corners stay sharp. It starts at `seeds_m`, points on or near the surface, and follows the surface from
/// cube to cube within `bounds`, where it stays open. Errors: usage for a spacing that gives more than 2^19
/// cubes along a side; interrupted.
Result<Mesh> dual_contour(const SolidFunction& solid, const Box& bounds, std::span<const Vec3> seeds_m,
                          const DualContourOptions& options, const Work& work);

}  // namespace palpable::sculpt
