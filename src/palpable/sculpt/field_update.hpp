// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/mesh.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/distance_field.hpp"
#include "palpable/sculpt/distance_source.hpp"
#include "palpable/sculpt/field_from_source.hpp"

namespace palpable::sculpt {

/// The field of a solid that differs from the field's own only by the triangles `changed` (at least one), as
/// they were and as they are: only cells where one of them is the nearest are sampled again from `source`,
/// the solid as it is. All other cells keep their contents to the bit. The bound is the field's own, and its
/// errors stay those measured when it was built. Errors: failed for a solid that leaves the field's grid;
/// else as field_from_source().
Result<models::DistanceField> updated_field(const models::DistanceField& field, const DistanceSource& source,
                                            const Mesh& changed, const FieldOptions& options,
                                            const Work& work);

}  // namespace palpable::sculpt
