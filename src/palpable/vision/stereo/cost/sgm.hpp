// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"

namespace palpable::vision {

/// The penalties of semi-global matching (Mei et al. 2011, section 3.3).
struct SgmOptions {
  /// For a step of one disparity; units of the volume, 0 … 5.
  float small_step = 1.0F;
  /// For a larger step; units, 0 … 5.
  float large_step = 3.0F;
  /// Neighbours that differ by this much, in the channel that differs most, have an edge between them; levels
  /// of 255, 1 … 255.
  int edge_levels = 15;
  /// Divisors of the penalties if one picture has an edge, and if both have; 1 … 100.
  int one_edge_divisor = 4;
  int both_edges_divisor = 10;
};
std::vector<Parameter> parameters_of(SgmOptions& options);

/// Semi-global aggregation over four paths (left, right, up, down; Hirschmueller 2008, eq. 13). `sums` gets
/// the sum of the four path costs in units of 1/kCostUnit and must have the volume's sizes. The result does
/// not depend on the number of threads.
void aggregate_paths(const CostVolume& costs, const ColourPlanes& reference, const ColourPlanes& other,
                     const SgmOptions& options, CostVolume& sums, const Work& work);

/// The disparity of least cost at each pixel, sub-pixel by the parabola through its neighbours.
Raster<float> least_cost_disparity(const CostVolume& costs, const Work& work);

}  // namespace palpable::vision
