// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/planes/plane_search.hpp"

namespace palpable::vision {

/// Parameters of remove_false_islands().
struct FalseIslandOptions {
  /// Neighbours belong to one surface if they differ by less; px, 0.1 … 10.
  float joined_px = 1.0F;
  /// Surfaces that cover at most this share of the picture are tested; 0 … 1.
  double largest_share = 0.01;
  /// Planes of the surroundings that are tried; 1 … 1000.
  int tried_planes = 8;
};
std::vector<Parameter> parameters_of(FalseIslandOptions& options);

/// Removes false small surfaces (islands) in front of the real one, which repeated patterns produce
/// consistently in both views. A real surface in front occludes pixels in the other picture, so these pixels
/// must not match well. For every small surface in front of its surroundings, the cost of its pixels plus
/// that of the pixels that it would occlude although they match is compared with the cost on a plane
/// continued from its surroundings. If the plane is cheaper, the surface is moved to it, in `start` too.
/// Costs are those of plane_costs().
void remove_false_islands(const CostVolume& volume, const FalseIslandOptions& options,
                          const PlaneCostOptions& costs, PlaneMap& map, PlaneMap& start);

}  // namespace palpable::vision
