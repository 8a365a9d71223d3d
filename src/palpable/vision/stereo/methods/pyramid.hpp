// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/occlusion/weighted_median.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <vector>

namespace palpable::vision {

/// Position of disparity steps: as found by correlation, or moved to the picture's edges (Cochran & Medioni
/// 1992).
enum class PyramidEdges { area, features };

/// The parts of the method `pyramid`.
struct PyramidOptions {
  /// Weight of a smooth surface relative to the data term's weight of 0 to 1; 0.001 … 100.
  float surface_weight = 0.5F;
  /// Rounds of the refinement; 0 … 1000.
  int iterations = 20;
  /// A neighbour that differs by more is on another surface, and there is no smoothing across; px, 0.1 … 100.
  float surface_px = 1.5F;
  PyramidEdges edges = PyramidEdges::area;
  /// With PyramidEdges::features: greatest shift of disparity steps (px, 0 … 60), and least contrast of an
  /// edge; levels of 255, 0 … 255.
  int edge_reach_px = 4;
  int edge_levels = 12;
  /// Least short side of the coarsest picture (px, 8 … 10000) and its least number of disparities (2 … 1000).
  int coarsest_side_px = 128;
  int coarsest_disparities = 8;
  /// Rounds in which inconsistent pixels are matched again (0 … 20), near the disparities of consistent
  /// pixels within this reach; px, 1 … 30.
  int rematch_rounds = 3;
  int rematch_reach_px = 4;
  /// Standard deviation of pixel noise, which must not count as texture; levels of 255, 0.1 … 50.
  float noise_levels = 2.0F;
  /// The least weight of a consistent match; 0.001 … 1.
  float least_trust = 0.05F;
  WeightedMedianOptions median = {};
};
std::vector<Parameter> parameters_of(PyramidOptions& options);
/// Errors: usage, for a parameter out of its range.
Result<void> check(const PyramidOptions& options);

/// The method `pyramid` (Beeler et al. 2010 as described by Gomez 2012): from coarse to fine by normalised
/// correlation. No pixel is left unknown. Errors: usage (check()), interrupted. The result does not depend on
/// the number of threads.
Result<MatchOutput> match_pyramid(const MatchInput& input, const PyramidOptions& options, const Work& work);

}  // namespace palpable::vision
