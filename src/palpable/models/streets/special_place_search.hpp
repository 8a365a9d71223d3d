// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"

#include <vector>

namespace palpable::models {

/// What on a map's picture is a special place. Initial values, not tuned.
struct SpecialPlaceSearchOptions {
  /// Least roundness 4 pi A / L^2 of a roundabout's ring: 1 for a circle, 0.785 for a square. 0.5 ... 1.
  double least_roundness = 0.85;
  /// Its diameter, in widths of its streets. 0.5 ... 10; 1 ... 50.
  double least_diameter = 1.5;
  double most_diameter = 8.0;
  /// How far from the middle of its words a building may be, in heights of their box. 0 ... 20.
  double label_reach = 2.0;
};
std::vector<Parameter> parameters_of(SpecialPlaceSearchOptions& options);

/// Adds the special places that a map shows by the words at them ("St Mary's Church") and by shape: small
/// round rings of streets are roundabouts, and their junctions are marked. For maps from pictures; extracts
/// state theirs.
void add_special_places(StreetMap& map, const SpecialPlaceSearchOptions& options = {});

}  // namespace palpable::models
