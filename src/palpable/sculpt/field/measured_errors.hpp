// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/models/field/field_errors.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"

#include <functional>

namespace palpable::sculpt {

/// The range of distances in which a field's errors are measured.
struct ErrorRange {
  double inside_m = 0.0;
  double outside_m = 0.0;
};

/// Measures the errors of the distance `felt` at up to 20000 random points of `box` whose distance is within
/// `range` of the surface: 99th percentile and maximum (bound_m stays 0). Deterministic for work.seed.
models::FieldErrors measured_errors(const std::function<double(Vec3 place_m)>& felt, const Box& box,
                                    const DistanceSource& source, const ErrorRange& range, const Work& work);

}  // namespace palpable::sculpt
