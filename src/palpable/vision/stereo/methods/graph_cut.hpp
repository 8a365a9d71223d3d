// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/cost/cross_window.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <vector>

namespace palpable::vision {

/// The energy of the method `graph-cut` (Park & Howard 2012, equations 1-5 as docs/stereo.md corrects them)
/// and how it is minimised.
struct GraphCutOptions {
  /// The data term.
  AggregationOptions data = {};
  /// The smoothness of neighbours of one colour, per pixel of disparity; units of the matching cost, 0 … 500.
  float smoothness = 32.0F;
  /// The smoothness across the strongest edge; units, 0 … 500.
  float edge_smoothness = 3.0F;
  /// It falls from one to the other with this decay constant of the colour difference, mean of the channels;
  /// levels of 255, 0.1 … 255.
  float edge_levels = 8.0F;
  /// Disparities that differ by more cost no more; px, 1 … 100.
  float truncation_px = 2.0F;
  /// From coarse to fine: a picture with at most few_disparities, or fewer than few_pixels on its short side,
  /// is solved with all labels everywhere; 2 … 1000, 8 … 10000.
  int few_disparities = 10;
  int few_pixels = 64;
  /// Expansion moves over all labels; 1 … 20.
  int passes = 2;
  /// Labels tried in a cell of 16 x 16 pixels: those of the coarser solution up to this far around it (px, 0
  /// … 100),
  int candidate_reach_px = 8;
  /// and those of least cost at no fewer than this many of its pixels, which the coarser picture could not
  /// resolve; px, 1 … 256.
  int candidate_pixels = 12;
  /// Iterations of the membrane through integer disparities; 0 … 1000.
  int membrane_iterations = 40;
};
std::vector<Parameter> parameters_of(GraphCutOptions& options);
/// Errors: usage, for a parameter out of its range or a window that is too large.
Result<void> check(const GraphCutOptions& options);

/// The method `graph-cut`: expansion moves by minimum cuts, from coarse to fine. No pixel is left unknown.
/// Errors: usage (check()), interrupted. The result does not depend on the number of threads.
Result<MatchOutput> match_graph_cut(const MatchInput& input, const GraphCutOptions& options,
                                    const Work& work);

}  // namespace palpable::vision
