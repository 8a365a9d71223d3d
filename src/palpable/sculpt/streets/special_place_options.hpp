// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"

#include <vector>

namespace palpable::sculpt {

/// How special places are felt.
struct SpecialPlaceOptions {
  /// Height of special buildings above the other ones, 0 ... 10 mm.
  double rise_m = 0.0008;
  /// Diameter of the round symbol of a building that is narrower than this or has no outline, 1 ... 20 mm.
  double symbol_m = 0.004;
  /// How far from its building a symbol may lie where there is no room, 0 ... 20 mm.
  double reach_m = 0.006;
  /// Diameter of the textured patch of a stop, a crossing or an entrance, 0.5 ... 20 mm.
  double patch_m = 0.0025;
};
std::vector<Parameter> parameters_of(SpecialPlaceOptions& options);

}  // namespace palpable::sculpt
