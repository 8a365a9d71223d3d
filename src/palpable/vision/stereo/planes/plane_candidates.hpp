// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/planes/planes.hpp"
#include "palpable/vision/stereo/planes/region_planes.hpp"

#include <array>
#include <vector>

namespace palpable::vision {

/// The candidate planes of every pixel: its own plane, planes fitted around it, its neighbours', its
/// region's, the other view's, and small random changes.
struct PlaneCandidates {
  static constexpr int kCount = 16;
  int width = 0;
  int height = 0;
  std::vector<float> disparity, slope_x, slope_y, cost;
  /// The path costs of the downward and the upward sweep.
  std::array<std::vector<float>, 2> path_sum;

  PlaneCandidates(int width_, int height_);
  std::size_t at(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) *
           static_cast<std::size_t>(kCount);
  }
};

/// Parameters of candidate planes.
struct PlaneProposalOptions {
  /// The windows of the two plane fits around a pixel.
  FitWindow fine = {.radius_px = 3, .step_px = 1};
  FitWindow broad = {.radius_px = 12, .step_px = 3};
  PlaneFitOptions fit = {};
  RegionPlaneOptions regions = {};
  /// Near neighbours are at most this far away; px, 1 … 60.
  int near_reach_px = 3;
  /// Far neighbours are at most this far away, alternating from round to round, so that planes propagate
  /// across large untextured areas in few rounds; px, 1 … 200.
  std::array<int, 8> far_reach_px = {2, 6, 14, 4, 20, 9, 3, 30};
  /// The largest random change of a disparity in the first round; px, 0 … 10. It is multiplied by
  /// change_decay (0 … 1) in each round, down to least_change_px; px, 0 … 10.
  float first_change_px = 0.5F;
  float change_decay = 0.6F;
  float least_change_px = 0.06F;
  /// The second changed candidate: its change of disparity and of the slopes, as shares of the first's; 0
  /// … 2.
  float second_change = 0.5F;
  float slope_change = 0.2F;
};
std::vector<Parameter> parameters_of(PlaneProposalOptions& options);

/// The sources of candidate planes.
struct KnownPlanes {
  const PlaneMap& now;
  /// The first match.
  const PlaneMap& start;
  /// Weight of each pixel's plane for its neighbours, 0…1.
  const Raster<float>& trust;
  /// Regions of similar colour.
  const Regions& regions;
  /// The other view's planes in this view's frame (planes_in_other_view); none if null.
  const PlaneMap* from_other_view = nullptr;
};

/// Fills the candidates' planes for round `round` (0, 1, …) of the search.
void propose_planes(const ColourPlanes& colour, const KnownPlanes& known, const PlaneProposalOptions& options,
                    int round, PlaneCandidates& out, const Work& work);

}  // namespace palpable::vision
