// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"
#include "palpable/vision/stereo/planes/edge_evidence.hpp"

#include <vector>

namespace palpable::vision {

/// Where a step of disparity in a plain surface beside a colour edge is moved to the edge.
struct PlainStepOptions {
  /// A step is looked for in so many pixels of a plain surface beside an edge, along the row and the column;
  /// px, 0 … 60; 0 = none.
  int reach_px = 12;
  /// A step: the disparity falls by more over two pixels; px, 0.1 … 100.
  float least_step_px = 1.0F;
  /// The band between edge and step belongs to the surface beyond the edge if they differ by at most this;
  /// px, 0 … 10.
  float same_px = 1.0F;
  /// Which surfaces are plain, and what an edge is; `reach_px` is not used.
  EdgeEvidenceOptions edges = {.plain_px = 16, .plain_levels = 14};
};
std::vector<Parameter> parameters_of(PlainStepOptions& options);

/// Moves steps of disparity within plain surfaces to their edges. A window that contains an outline matches
/// at the nearer surface's disparity, so a nearer surface reaches into a plain one beside it by the windows'
/// width. A plain surface that ends at a colour edge, has the disparity of the surface beyond the edge up to
/// `reach_px` from it, and a smaller one further away, gets the smaller one up to the edge. All disparities
/// are finite. The result does not depend on the number of threads.
void move_steps_in_plain_surfaces(const ColourPlanes& colour, const PlainStepOptions& options,
                                  Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
