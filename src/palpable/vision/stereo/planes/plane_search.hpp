// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/cost_volume.hpp"
#include "palpable/vision/stereo/planes/planes.hpp"
#include "palpable/vision/stereo/planes/region_planes.hpp"

#include <array>
#include <vector>

namespace palpable::vision {

/// A semi-global search over slanted planes: each pixel has a handful of candidate planes, drawn from its own
/// plane, planes fitted around it, its neighbours', its region's, the other view's and small changes; eight
/// path sweeps (Hirschmueller 2008) carry a smoothness that costs nothing along a plane: |f_p(q) - f_q(q)| +
/// |f_p(p) - f_q(p)| (the curvature of Olsson, Ulen & Boykov 2013), truncated, and weaker across colour
/// edges. The cheapest candidate becomes the pixel's plane, and the next round draws anew from there.
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

/// What the other view says about a disparity (see plane_costs).
struct OtherView {
  /// The other picture's disparities on this picture's mirror convention: pixel (x, y) here matches
  /// (x - d, y) there, and disparity(x - d, y) is d again; infinite where that picture shows nothing.
  const Raster<float>* disparity = nullptr;
  /// Nothing lies further away than this.
  float least_px = 0.0F;
  /// While its disparities are unknown: it shows something from this column on.
  int first = 0;
};

/// What a pixel hidden from the other camera costs, in units.
inline constexpr float kHiddenCost = 1.2F;

/// The matching cost at any disparity, in units: between those of the volume by a cubic, beyond its ends
/// rising.
float matching_cost_at(const CostVolume& volume, int x, int y, float disparity);

/// What candidates are drawn from.
struct KnownPlanes {
  const PlaneMap& now;
  /// The first match.
  const PlaneMap& start;
  /// How much each pixel's plane counts for its neighbours, 0…1.
  const Raster<float>& trust;
  /// Of like colour.
  const Regions& regions;
  /// The other view's planes as seen from here (planes_across); none if null.
  const PlaneMap* across = nullptr;
};

/// Fills the candidates' planes for round `round` (0, 1, …) of the search.
void propose_planes(const ColourPlanes& colour, const KnownPlanes& known, int round, PlaneCandidates& out,
                    const Work& work);

/// Sets the candidates' own costs from the volume, between its disparities by a cubic. With another view, a
/// candidate that lies behind the other view's surface is hidden there and costs a constant; one that lies
/// in front of it should have been seen there and is charged for it.
void plane_costs(const CostVolume& volume, const OtherView& other, PlaneCandidates& candidates,
                 const Work& work);

/// Runs the sweeps and gives each pixel its cheapest candidate. The same result for any number of threads.
void choose_planes(const ColourPlanes& colour, PlaneCandidates& candidates, PlaneMap& out, const Work& work);

}  // namespace palpable::vision
