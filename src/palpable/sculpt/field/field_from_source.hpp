// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <cstddef>
#include <vector>

namespace palpable::sculpt {

struct FieldOptions {
  /// Finest cells along the solid's longest side, 16 ... 4096.
  int resolution = 512;
  /// The error bound near the surface where the distance is smooth, metres; 0 = a ten-thousandth of the
  /// longest side (10 um in 100 mm).
  double max_error_m = 0.0;
  /// The band in which the bound holds: this deep inside and this far outside, but at least 3 % and 1 % of
  /// the longest side, and at most 15 % and 5 %.
  double inside_m = 0.003;
  double outside_m = 0.001;
  /// Empty space around the solid, 0 ... 0.05 m, which is also the largest radius of a ball that touches the
  /// field; 0 = field_margin_m()'s rule.
  double margin_m = 0.0;
  /// A field that would need more memory is refused before it is allocated.
  std::size_t most_bytes = std::size_t{1} << 31U;
};

/// All parameters except most_bytes, which does not affect the result. Defaults were chosen on generated
/// solids and scans (docs/fields.md).
std::vector<Parameter> parameters_of(FieldOptions& options);

/// Side of the finest cells for a solid in `bounds`. Errors: usage for options out of range; invalid_input
/// for a solid without extent.
Result<double> finest_cell_m(const Box& bounds, const FieldOptions& options);

/// FacetOptions::rounding_m for a field (solid_from_mesh()): a tenth of a finest cell, the tolerance of an
/// edge's position (docs/fields.md), and no more than twice the error bound. 0 for what finest_cell_m()
/// refuses.
double facet_rounding_m(const Box& bounds, const FieldOptions& options);

/// Margin of a field around the solid in `bounds`: `asked_m`; if that is 0, 6 % of the solid's longest side,
/// at least 2 mm, but no more than 10 % of the side because of that minimum.
double field_margin_m(const Box& bounds, double asked_m);

/// Samples a solid's distance adaptively: cells that no leaf of models/field/field_leaf.hpp fits are split
/// into eight until they are the finest. The grid surrounds the solid by field_margin_m(). Long work: all
/// threads, reports progress, polls cancel; the same for any number of threads. Errors: as finest_cell_m();
/// failed for a field over most_bytes, naming about what it would take and the resolution that fits;
/// interrupted.
Result<models::DistanceField> field_from_source(const DistanceSource& source, const FieldOptions& options,
                                                const Work& work);

}  // namespace palpable::sculpt
