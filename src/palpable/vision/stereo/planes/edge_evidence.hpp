// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/image/colour_planes.hpp"

#include <vector>

namespace palpable::vision {

/// Which pixels beside a colour edge match as the nearer surface beyond it.
struct EdgeEvidenceOptions {
  /// Columns beside an edge; px, 0 … 20; 0 = none.
  int reach_px = 5;
  /// An edge: the difference of pixels two columns apart exceeds this, and so does that of the surface to
  /// each of the beyond_px (2 … 60) columns beyond; levels of 255, 1 … 255.
  int edge_levels = 40;
  int beyond_px = 4;
  /// The surface is plain if this many columns, beginning two from the edge, differ by at most plain_levels
  /// (levels of 255, 0 … 255) from the first of them; px, 1 … 60.
  int plain_px = 10;
  int plain_levels = 19;
  /// The surface beyond the edge counts as the nearer one unless it is this much farther away; px, 0 … 10.
  float farther_px = 0.5F;
};
std::vector<Parameter> parameters_of(EdgeEvidenceOptions& options);

/// The last pixel of a surface before a colour edge; (dx, dy), a unit step along the row or column, leads
/// from the edge into the surface.
struct SurfaceEnd {
  int x = 0, y = 0;
  int dx = 0, dy = 0;
};

/// Whether a plain surface ends at an edge there; false near the picture's border.
bool is_plain_up_to_edge(const ColourPlanes& colour, const SurfaceEnd& end,
                         const EdgeEvidenceOptions& options);

/// Where the matching cost favours a nearer surface than a pixel's own: that surface's disparity; NaN
/// elsewhere. The outline between two surfaces moves with the nearer one. Mixed and sharpened pixels, and
/// windows that contain them, match at its disparity, too; beside it some pixels of the farther surface are
/// hidden. If the farther surface is plain, nothing else in it contradicts. So the columns of a plain surface
/// beside a colour edge are marked, unless `disparity_px`, the present map, says that the surface beyond the
/// edge is the farther one. The result does not depend on the number of threads.
Raster<float> nearer_beyond_edges(const ColourPlanes& colour, const Raster<float>& disparity_px,
                                  const EdgeEvidenceOptions& options, const Work& work);

}  // namespace palpable::vision
