// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/occlusion/weighted_median.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

#include <vector>

namespace palpable::vision {

/// Where disparity steps: as correlation finds it, or moved to the picture's edges (Cochran & Medioni 1992).
enum class PyramidEdges { area, features };

/// The parts of the method `pyramid`.
struct PyramidOptions {
  /// Weight of a smooth surface against that of the picture, which lies between 0 and 1; 0.001 … 100.
  float surface_weight = 0.5F;
  /// Rounds of the refinement; 0 … 1000.
  int iterations = 20;
  /// A neighbour that differs by more is on another surface: nothing is smoothed across; px, 0.1 … 100.
  float surface_px = 1.5F;
  PyramidEdges edges = PyramidEdges::area;
  /// With PyramidEdges::features: steps of disparity move at most so far (px, 0 … 60), to edges of at least
  /// this contrast; levels of 255, 0 … 255.
  int edge_reach_px = 4;
  int edge_levels = 12;
  /// The coarsest picture has at least this short side (px, 8 … 10000) and so many disparities (2 … 1000).
  int coarsest_side_px = 128;
  int coarsest_disparities = 8;
  /// Rounds in which pixels that break a constraint are matched again (0 … 20), near the disparities of the
  /// pixels up to this far around that keep all; px, 1 … 30.
  int rematch_rounds = 3;
  int rematch_reach_px = 4;
  /// Standard deviation of a pixel's noise, which must not pass for texture; levels of 255, 0.1 … 50.
  float noise_levels = 2.0F;
  /// The least weight of a match that keeps all constraints; 0.001 … 1.
  float least_trust = 0.05F;
  WeightedMedianOptions median = {};
};
std::vector<Parameter> parameters_of(PyramidOptions& options);
/// Errors: usage, for a parameter out of its range.
Result<void> check(const PyramidOptions& options);

/// The method `pyramid`, Beeler's as Gomez describes it: from coarse to fine by normalised correlation. No
/// pixel is left unknown. Errors: usage (check()), interrupted. The same bytes for every number of threads.
Result<MatchOutput> match_pyramid(const MatchInput& input, const PyramidOptions& options, const Work& work);

}  // namespace palpable::vision
