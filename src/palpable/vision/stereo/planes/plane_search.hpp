// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"
#include "palpable/vision/stereo/planes/plane_candidates.hpp"

#include <cstdint>
#include <vector>

// A semi-global search over slanted planes: every pixel has a handful of candidate planes, and eight path
// sweeps (Hirschmueller 2008) minimise a smoothness that costs nothing along a plane: |f_p(q) - f_q(q)| +
// |f_p(p) - f_q(p)| (the curvature of Olsson, Ulen & Boykov 2013), truncated, and weaker across colour edges.
// The candidate of least cost becomes the pixel's plane, and the next round draws new candidates from it.
namespace palpable::vision {

/// The unary cost of a candidate, in units of the volume.
struct PlaneCostOptions {
  /// Per unit of slope (px of disparity per px), |slope_x| + |slope_y|; units, 0 … 5.
  float slope_cost = 0.2F;
  /// Cost of an occluded pixel; units, 0 … 4.
  float hidden_cost = 1.2F;
  /// Cost of a candidate that the other camera should see but does not; units, 0 … 4.
  float conflict_cost = 0.7F;
  /// Cost per pixel beyond the range of disparities; units, 0 … 5.
  float beyond_range_per_px = 0.5F;
  /// Disparities of the two views that differ by less agree; px, 0.1 … 5.
  float agreement_px = kLeftRightTolerance_px;
  /// Beyond that hidden_cost and conflict_cost increase linearly over this difference; px, 0.01 … 5.
  float ramp_px = 0.5F;
};
std::vector<Parameter> parameters_of(PlaneCostOptions& options);

/// The smoothness between neighbours. Costs are in units of the volume.
struct PlaneSmoothnessOptions {
  /// Cost per pixel of disparity between the two planes (mean at the two neighbours); units, 0 … 10.
  float step_per_px = 0.6F;
  /// The smoothness cost is truncated here; units, 0 … 10.
  float largest_step = 3.0F;
  /// Both are weighted by colour: the weight falls by e with this difference; levels of 255, 1 … 255.
  float colour_levels = 12.0F;
  /// The least weight, across the strongest edge; 0 … 1.
  float least_weight = 0.08F;
  /// The weight of diagonal neighbours; 0 … 1.
  float diagonal_weight = 0.7F;
};
std::vector<Parameter> parameters_of(PlaneSmoothnessOptions& options);

/// The other view, for visibility (see plane_costs).
struct OtherView {
  /// The other picture's disparities in its own frame: pixel (x, y) here matches (x - d, y) there, and
  /// disparity(x - d, y) is d again; infinite where that picture has no content.
  const Raster<float>* disparity = nullptr;
  /// Least disparity: nothing is farther away.
  float least_px = 0.0F;
  /// If its disparities are unknown: its picture has content from this column on.
  int first = 0;
};

/// The matching cost at a real disparity, in units: interpolated by a Catmull-Rom cubic, and beyond the
/// volume's ends increasing by `beyond_range_per_px`.
float matching_cost_at(const CostVolume& volume, int x, int y, float disparity, float beyond_range_per_px);

/// Sets the candidates' own costs from the volume. With another view, a candidate behind the other view's
/// surface is occluded there and has a constant cost; one in front of it should be visible there and costs
/// more. At a pixel with a disparity in `nearer_px` (of the volume's size, NaN = none; null = none at all) a
/// candidate behind it has at most its matching cost (edge_evidence.hpp).
void plane_costs(const CostVolume& volume, const OtherView& other, const PlaneCostOptions& options,
                 PlaneCandidates& candidates, const Work& work, const Raster<float>* nearer_px = nullptr);

/// Runs the sweeps and assigns each pixel its candidate of least cost. The result does not depend on the
/// number of threads.
void choose_planes(const ColourPlanes& colour, const PlaneSmoothnessOptions& options,
                   PlaneCandidates& candidates, PlaneMap& out, const Work& work);

}  // namespace palpable::vision
