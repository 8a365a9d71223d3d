// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <limits>
#include <optional>

namespace palpable::sculpt {

/// The difference between a solid and the one that a field was made from, and the region in which the field
/// is updated.
struct SolidChange {
  /// The triangles that changed, at least one, before and after the change.
  Mesh triangles;
  /// Places farther than within_m from this surface do not change. At least one triangle, which may be
  /// degenerate. Not used if within_m is infinite.
  Mesh around;
  double within_m = std::numeric_limits<double>::infinity();
  /// The greatest displacement of the surface.
  double step_m = 0.0;
};

/// The field of a solid that changed. Only cells whose nearest triangle may have changed are sampled again
/// from `source`, the changed solid; all other cells stay identical bit by bit. The error bound is the
/// field's own, and its errors stay those measured when it was built.
///
/// With a finite within_m (the bounding volume of Moustakas et al. 2007) the distance is that of the changed
/// solid as far from the surface as the field's bound holds, if within_m allows that. From there to within_m
/// it blends smoothly into the earlier field's distance, so the field stays the potential of its force.
/// nullopt if the two distances differ so much that the blend might not decrease inwards: then the whole
/// field must be built again. Errors: failed for a solid that leaves the field's grid; else as
/// field_from_source().
Result<std::optional<models::DistanceField>> updated_field(const models::DistanceField& field,
                                                           const DistanceSource& source,
                                                           const SolidChange& change,
                                                           const FieldOptions& options, const Work& work);

}  // namespace palpable::sculpt
