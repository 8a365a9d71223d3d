// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/segmentation/colour_segments.hpp"
#include "palpable/vision/stereo/problem/stereo_method.hpp"

#include <cstddef>
#include <vector>

namespace palpable::vision {

/// A plane in disparity: d = at_middle + slope_x (x - x0) + slope_y (y - y0), in pixels.
struct SegmentPlane {
  double x0 = 0.0, y0 = 0.0;
  double at_middle = 0.0;
  double slope_x = 0.0, slope_y = 0.0;
  /// So many trusted pixels lie within a pixel of it.
  int support = 0;
  double at(int x, int y) const { return at_middle + slope_x * (x - x0) + slope_y * (y - y0); }
};

/// A picture's colour segments, each on a plane.
struct SegmentPlanes {
  ColourSegments segments;
  std::vector<SegmentPlane> planes;
  /// The plane of each segment.
  std::vector<std::size_t> plane_of;

  const SegmentPlane& at(int x, int y) const {
    return planes[plane_of[static_cast<std::size_t>(segments.of_pixel(x, y))]];
  }
};

/// Hong & Chen 2004 as Gomez 2012 describes it (chapter 8): mean-shift segments of the left picture, planes
/// fitted to their disparities, and planes given to segments by graph cuts. Errors: interrupted; failed where
/// the picture is too large for the filter's memory. The same result for any number of threads.
Result<SegmentPlanes> find_segment_planes(const MatchInput& input, const Work& work);

}  // namespace palpable::vision
