// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/dense_field.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <cstddef>

namespace palpable::sculpt {

struct DenseFieldOptions {
  /// `distance`: the source's exact distance at every point. `distance_and_force`, as in Moustakas et al.
  /// 2007: exact within a cell of the surface, continued by fast marching together with the force.
  models::DenseContent content = models::DenseContent::distance;
  /// Cells along the solid's longest side, 16 ... 4096.
  int resolution = 512;
  /// As FieldOptions::margin_m.
  double margin_m = 0.0;
  /// A larger field is refused before any work is done.
  std::size_t most_bytes = std::size_t{1} << 31U;
};

/// The lattice for a solid in `bounds`, which surrounds it by field_margin_m(). Quick.
/// Errors: as finest_cell_m(); failed for one over most_bytes, with the size that it would need and the
/// resolution that fits.
Result<models::Lattice> lattice_around(const Box& bounds, const DenseFieldOptions& options);

/// Samples the field. Long work: all threads for sampling (fast marching uses one), reports progress, polls
/// cancel. The result does not depend on the number of threads. Errors: as lattice_around(); invalid_input
/// for a solid without a place of the lattice inside it; interrupted.
Result<models::DenseField> dense_field_from_source(const DistanceSource& source,
                                                   const DenseFieldOptions& options, const Work& work);

}  // namespace palpable::sculpt
