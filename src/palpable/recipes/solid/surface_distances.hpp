// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <span>
#include <vector>

namespace palpable::recipes {

// Unsigned distances of points from a surface, in their own unit. All threads are used.

/// From a mesh with at least one triangle.
std::vector<double> distances_from(std::span<const Vec3> points, const Mesh& surface, const Work& work);
/// From the union of superquadrics. Errors: as sculpt::distance_of().
Result<std::vector<double>> distances_from(std::span<const Vec3> points,
                                           std::span<const models::Superquadric> shapes, const Work& work);

/// The mean distance where each counts as `most` at most; 0 of none.
double mean_distance(std::span<const double> distances, double most);

}  // namespace palpable::recipes
