// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/dense_field.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/models/field/superquadric.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <memory>
#include <vector>

namespace palpable::models {

/// A solid as a touchable model: its distance field, and a height map of its view from above (+z) for planar
/// devices and for pictures. Immutable.
template <DistanceSurface Distance>
struct SolidField {
  Distance distance;
  /// The box of the solid itself, inside the field's grid.
  Vec3 least_m;
  Vec3 most_m;
  /// Never null. Centred on the scene's origin like every relief; places without the solid have the height of
  /// its lowest point.
  std::shared_ptr<const Relief> from_above;
  /// The superquadrics that it was sampled from; empty for other solids.
  std::vector<Superquadric> primitives;

  /// The least space between the solid and the border of its field: from farther away than that the distance
  /// is not the field's own (outside_box()).
  double margin_m() const {
    const Vec3 below = least_m - distance.origin_m();
    const Vec3 above = distance.origin_m() + distance.size_m() - most_m;
    return std::min({below.x, below.y, below.z, above.x, above.y, above.z});
  }
  std::size_t memory_bytes() const { return distance.memory_bytes() + from_above->memory_bytes(); }
};

/// The default: an adaptively sampled field.
using Field = SolidField<DistanceField>;
/// A dense field, for comparison.
using FieldOnLattice = SolidField<DenseField>;

/// Makes the model and computes its view from above. Errors: invalid_input for a box that is empty or not
/// finite.
Result<Field> field_of(DistanceField distance, Vec3 least_m, Vec3 most_m);
Result<FieldOnLattice> field_of(DenseField distance, Vec3 least_m, Vec3 most_m);

}  // namespace palpable::models
