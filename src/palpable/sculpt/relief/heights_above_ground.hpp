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
  /// A relief has a ground where this share of its samples lies on one plane, and at most this share under
  /// it. 0 … 1 each.
  double least_share = 0.25;
  double most_under_share = 0.05;
  /// Samples that are at most this share of the relief's height from the plane lie on it. 0.001 … 0.5.
  double tolerance_share = 0.02;
  /// The bent ground lies at most this many tolerances beside the plane, so that no object becomes ground. 0
  /// … 20; 0 = the plane.
  double most_bend = 6.0;
};
std::vector<Parameter> parameters_of(FlattenOptions& options);

/// Heights of a relief's samples above its own ground, m: the plane, level or tilted, that most of it lies
/// on, bent as a quadratic surface where its samples are: how depth becomes height bends a table's plane.
/// Samples on the ground or under it are 0. nullopt where no plane holds enough, or Work is cancelled. The
/// options must be in their ranges.
std::optional<Raster<float>> heights_above_ground(const models::Relief& relief, const Work& work,
                                                  const FlattenOptions& options = {});

}  // namespace palpable::sculpt
