// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/field/field_from_source.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <limits>
#include <optional>

namespace palpable::sculpt {

/// By what a solid differs from the one that a field was made of, and how far from there the field follows.
struct SolidChange {
  /// The triangles that changed, at least one, as they were and as they are.
  Mesh triangles;
  /// Farther than within_m from this surface (at least one triangle, which may have no extent) nothing is
  /// touched. Not looked at where within_m is infinite.
  Mesh around;
  double within_m = std::numeric_limits<double>::infinity();
  /// The longest way that the surface moved.
  double step_m = 0.0;
};

/// The field of a solid that changed: only cells where a changed triangle is the nearest are sampled again
/// from `source`, the solid as it is. All other cells keep their contents to the bit. The bound is the
/// field's own, and its errors stay those measured when it was built.
///
/// With a finite within_m (the bounding volume of Moustakas et al. 2007) distances are the solid's own as far
/// from the surface as the field's bound is promised, if within_m allows that, and go over smoothly into the
/// earlier field's from there to within_m. The field stays the potential of its force. Nothing is returned
/// where they differ so much that a way inwards might not lead deeper: then the field must be made anew.
/// Errors: failed for a solid that leaves the field's grid; else as field_from_source().
Result<std::optional<models::DistanceField>> updated_field(const models::DistanceField& field,
                                                           const DistanceSource& source,
                                                           const SolidChange& change,
                                                           const FieldOptions& options, const Work& work);

}  // namespace palpable::sculpt
