// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/methods/segment_planes.hpp"
#include "palpable/vision/stereo/planes/edge_evidence.hpp"
#include "palpable/vision/stereo/planes/plane_search.hpp"
#include "palpable/vision/stereo/planes/plane_votes.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <vector>

namespace palpable::vision {

/// The parts of the method `segments`.
struct SegmentsOptions {
  SegmentPlaneOptions planes = {};
  /// Rounds in which pixels are reassigned among the planes of nearby segments; 0 … 20.
  int border_rounds = 3;
  /// Cost of leaving the segment's plane; units of the volume, 0 … 4.
  float leave_cost = 0.2F;
  VolumeOptions volume = {};
  PlaneCostOptions costs = {};
  PlaneSmoothnessOptions smoothness = {};
  EdgeEvidenceOptions edges = {.reach_px = 0};
  BackgroundOptions background = {};
  PlaneVoteWindow contradicted = kContradictedWindow;
};
std::vector<Parameter> parameters_of(SegmentsOptions& options);
/// Errors: usage, for a parameter out of its range or a window that is too large.
Result<void> check(const SegmentsOptions& options);

/// The method `segments` (Hong & Chen 2004 as described by Gomez 2012): planes for colour segments, assigned
/// by graph cuts. No pixel is left unknown. Errors: usage (check()), interrupted, failed if the picture is
/// too large for the segmentation. The result does not depend on the number of threads.
Result<MatchOutput> match_segments(const MatchInput& input, const SegmentsOptions& options, const Work& work);

}  // namespace palpable::vision
