// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/cost/sgm.hpp"
#include "palpable/vision/stereo/planes/edge_evidence.hpp"
#include "palpable/vision/stereo/planes/false_islands.hpp"
#include "palpable/vision/stereo/planes/photometric_shift.hpp"
#include "palpable/vision/stereo/planes/plane_search.hpp"
#include "palpable/vision/stereo/planes/plane_votes.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <vector>

namespace palpable::vision {

/// The parts of the method `best`. docs/stereo.md says on which pictures the defaults were chosen.
struct BestOptions {
  /// First rounds of the plane search, of each view by itself; 1 … 20.
  int separate_rounds = 3;
  /// Following rounds, of both views with occlusions from each other; 0 … 20.
  int joint_rounds = 3;
  /// Last rounds, of the left view; 0 … 20.
  int last_rounds = 2;
  /// From this round on each view gets the other's planes as candidates; earlier they are mostly noise; 0 …
  /// 60.
  int first_exchange = 2;
  /// Q of statistical region merging: larger than elsewhere, since a region should contain one or two
  /// surfaces; 1 … 1024.
  double region_complexity = 128.0;
  /// An occluded pixel costs at least this much more than the median of the matches that both views confirm
  /// after their separate rounds (else `costs.hidden_cost`): in dark and noisy pictures true matches would
  /// cost more than occlusions; units, 0 … 4.
  float hidden_above_match = 0.4F;
  /// Share of the farthest visible pixels that are left out when the farthest visible disparity is
  /// determined; 0 … 0.5.
  double furthest_fraction = 0.005;
  /// An occluded surface lies at most this far behind that disparity; px, 0 … 100.
  float furthest_margin_px = 1.0F;
  VolumeOptions volume = {};
  SgmOptions sgm = {};
  PlaneProposalOptions proposals = {};
  PlaneCostOptions costs = {};
  PlaneSmoothnessOptions smoothness = {};
  EdgeEvidenceOptions edges = {};
  FalseIslandOptions islands = {};
  PhotometricShiftOptions shift = {};
  BackgroundOptions background = {};
  PlaneVoteWindow contradicted = kContradictedWindow;
};
std::vector<Parameter> parameters_of(BestOptions& options);
/// Errors: usage, for a parameter out of its range.
Result<void> check(const BestOptions& options);

/// The method `best`, the default for files. AD-Census costs (Mei et al. 2011) averaged over small crosses,
/// and semi-global matching, initialise both views. Then a semi-global search over slanted planes
/// (plane_search.hpp) turns steps into surfaces. In its later rounds each view determines the other's
/// occlusions, so that occluded surfaces continue as planes of the background. No pixel is left unknown.
/// docs/stereo-best.md has figures for each part. Errors: usage (check()), interrupted. The result does not
/// depend on the number of threads.
Result<MatchOutput> match_best(const MatchInput& input, const BestOptions& options, const Work& work);

}  // namespace palpable::vision
