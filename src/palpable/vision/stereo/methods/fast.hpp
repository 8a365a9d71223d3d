// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/cost/matching_cost.hpp"
#include "palpable/vision/stereo/occlusion/step_median.hpp"
#include "palpable/vision/stereo/planes/plain_steps.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <vector>

namespace palpable::vision {

/// The parts of the method `fast`.
struct FastOptions {
  /// The sum of both terms, halved, is at most 127.
  CostOptions cost = {.census_weight = 1, .colour_limit = 20, .colour_weight = 3, .halvings = 1};
  /// Costs are averaged with those of neighbours of similar colour, 1, 2, 4 … pixels away: number of passes
  /// along the row, and along the column; 0 … 5, 1 … 4.
  int row_passes = 3;
  int column_passes = 2;
  /// Neighbours that differ by less, in the channel that differs most, are similar; levels of 255, 1 … 255.
  int similar_levels = 20;
  /// The penalty of a step of more than one disparity between pixels of one colour; 1 … 127.
  float large_step = 120.0F;
  /// It falls by e with this colour difference (levels of 255, 1 … 255) …
  float step_colour_levels = 12.0F;
  /// … down to this value; 0 … 127.
  float least_large_step = 14.0F;
  /// The penalty of a step of one disparity, in 256ths of the larger one; 0 … 256.
  int small_step_share = 70;
  /// The picture is matched in an even number of stripes of at most this many rows, independent of the number
  /// of threads; 16 … 4096.
  int stripe_rows = 200;
  /// Rows above and below a stripe at which its paths begin; 0 … 200.
  int lead_in_rows = 12;
  /// Number of final 3 x 3 medians: two remove specks of a few pixels and keep corners sharper than one wide
  /// median; 0 … 10.
  int medians = 2;
  /// The large windows of the costs carry nearer surfaces beyond their edges: steps are moved back.
  StepMedianOptions steps = {};
  /// In plain surfaces beside colour edges they are moved farther.
  PlainStepOptions plain_steps = {};
};
std::vector<Parameter> parameters_of(FastOptions& options);
/// Errors: usage, for a parameter out of its range or a cost that could exceed 127.
Result<void> check(const FastOptions& options);

/// The method `fast`, for live use: AD-Census costs averaged over small crosses, semi-global matching over
/// eight paths, the right view's disparities from the same sums, occluded pixels filled from the background,
/// a median against specks, and steps of disparity moved to edges of colour. Gives a confidence of 0 or 1
/// (left-right check); no pixel is left unknown. Errors: usage (check()), interrupted. The result does not
/// depend on the number of threads.
Result<MatchOutput> match_fast(const MatchInput& input, const FastOptions& options, const Work& work);

}  // namespace palpable::vision
