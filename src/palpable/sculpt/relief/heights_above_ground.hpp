// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/relief/relief.hpp"

#include <optional>
#include <vector>

namespace palpable::sculpt {

struct FlattenOptions {
  /// A relief has a ground if at least this share of its samples lies on one plane, and at most this share
  /// under it. 0 … 1 each.
  double least_share = 0.25;
  double most_under_share = 0.05;
  /// Samples that are at most this share of the relief's height from the plane lie on it. 0.001 … 0.5.
  double tolerance_share = 0.02;
  /// The bent ground lies at most this many tolerances beside the plane, so that no object becomes ground. 0
  /// … 20; 0 = the plane.
  double most_bend = 6.0;
};
std::vector<Parameter> parameters_of(FlattenOptions& options);

/// Heights of a relief's samples above its own ground, m. The ground is the plane, level or tilted, on which
/// most samples lie, plus a quadratic surface, since the mapping of depth to height bends planes. Samples on
/// or under the ground are 0. nullopt if no plane contains enough samples, or Work is cancelled. The options
/// must be in their ranges.
std::optional<Raster<float>> heights_above_ground(const models::Relief& relief, const Work& work,
                                                  const FlattenOptions& options = {});

}  // namespace palpable::sculpt
