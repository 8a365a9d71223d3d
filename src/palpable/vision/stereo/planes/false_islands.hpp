// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/planes/plane_search.hpp"

namespace palpable::vision {

/// Which small surfaces are tested, and against what.
struct FalseIslandOptions {
  /// Neighbours belong to one surface when they differ by less; px, 0.1 … 10.
  float joined_px = 1.0F;
  /// Surfaces that cover at most this share of the picture are tested; 0 … 1.
  double largest_share = 0.01;
  /// Planes of the surroundings that are tried; 1 … 1000.
  int tried_planes = 8;
};
std::vector<Parameter> parameters_of(FalseIslandOptions& options);

/// Repeated patterns give false small surfaces in front of the real one, and both views agree about them. But
/// a real surface in front hides something from the other camera: the pixels that it would hide must not
/// match well themselves. Every small surface in front of its surroundings whose pixels cost more, together
/// with those that it would hide although they match, than on a continued plane of its surroundings is moved
/// back to that plane; in `start` too. Costs as plane_costs() counts them.
void remove_false_islands(const CostVolume& volume, const FalseIslandOptions& options,
                          const PlaneCostOptions& costs, PlaneMap& map, PlaneMap& start);

}  // namespace palpable::vision
