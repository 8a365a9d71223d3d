// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/dense_field.hpp"
#include "palpable/models/field/distance_field.hpp"

namespace palpable::sculpt {

/// The surface of a field as triangles, by dual contouring with cubes of `spacing_m` (a few finest cells).
/// Errors: as dual_contour(); failed for a field without a surface.
Result<Mesh> surface_of_field(const models::DistanceField& field, double spacing_m, const Work& work);
Result<Mesh> surface_of_field(const models::DenseField& field, double spacing_m, const Work& work);

}  // namespace palpable::sculpt
