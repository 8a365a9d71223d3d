// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/segmentation/colour_segments.hpp"
#include "palpable/vision/stereo/methods/scanline.hpp"
#include "palpable/vision/stereo/problem/match_input.hpp"

#include <array>
#include <cstddef>
#include <vector>

namespace palpable::vision {

/// A plane in disparity: d = at_middle + slope_x (x - x0) + slope_y (y - y0), in pixels.
struct SegmentPlane {
  double x0 = 0.0, y0 = 0.0;
  double at_middle = 0.0;
  double slope_x = 0.0, slope_y = 0.0;
  /// How many trusted pixels support it.
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

/// Parameters of plane fitting and assignment.
struct SegmentPlaneOptions {
  /// The picture's segments; `radius_px` 1 … 50, `colour_levels` 1 … 100, `same_levels` 1 … 255,
  /// `least_pixels` 1 … 100000.
  SegmentOptions segments = {};
  /// The disparities that planes are fitted to.
  ScanlineMapOptions scanlines = {};
  /// The costs of pixels on planes.
  AggregationOptions data = {};
  /// No plane is fitted to a segment with fewer trusted pixels; px, 3 … 100000.
  int least_trusted = 20;
  /// A robust fit in several steps: pixels farther from the plane than this do not count; px, 0.1 … 100.
  std::array<double, 6> fit_reach_px = {6.0, 4.0, 3.0, 2.0, 1.5, 1.5};
  /// A pixel within this of a plane supports it; px, 0.1 … 10.
  double support_px = 1.0;
  /// Ridge regression of the slopes. Neighbouring disparities share most of their windows and so their errors
  /// of about 0.5 px: about 40 pixels of a window carry the information of one. Slopes above 0.1 to 0.2 are
  /// rare. Hence 40 (0.5 / 0.15)^2; 0 … 1e6.
  double slope_ridge = 500.0;
  /// The steepest slope; px of disparity per px, 0 … 4.
  double steepest = 0.7;
  /// Planes that differ by less than same_px (px, 0 … 10), at the middle and same_radius_px (px, 0 … 1000)
  /// from it, are one.
  double same_px = 0.5;
  double same_radius_px = 20.0;
  /// The planes of most support are kept; 1 … 10000.
  int most_planes = 300;
  /// Smoothness for each pixel of a border between segments on different planes; units of the matching cost,
  /// 0 … 1000. It decays with the colour difference, by e per border_levels (mean of the channels, levels of
  /// 255, 0.1 … 255), down to the share least_border (0 … 1).
  double border_cost = 36.0;
  double border_levels = 12.0;
  double least_border = 0.2;
  /// Rounds of expansion moves; 1 … 20.
  int expansion_rounds = 3;
  /// How often planes are assigned to segments and refitted to all their segments; 1 … 20. Planes of fewer
  /// trusted pixels than refit_pixels (3 … 1e6) are not fitted again, the others refit_steps times (0 … 20)
  /// to the pixels within refit_reach_px (0.1 … 100).
  int assignments = 2;
  int refit_pixels = 40;
  int refit_steps = 3;
  double refit_reach_px = 1.5;
};
std::vector<Parameter> parameters_of(SegmentPlaneOptions& options);

/// Hong & Chen 2004 as described by Gomez 2012 (chapter 8): mean-shift segments of the left picture, planes
/// fitted to their disparities, and planes assigned to segments by graph cuts. Errors: interrupted; failed if
/// the picture is too large for the filter's memory. The result does not depend on the number of threads.
Result<SegmentPlanes> find_segment_planes(const MatchInput& input, const SegmentPlaneOptions& options,
                                          const Work& work);

}  // namespace palpable::vision
