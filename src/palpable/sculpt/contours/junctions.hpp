// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// A point where three or more lines meet, px (pixel centres at integers).
struct Junction {
  double x_px = 0.0;
  double y_px = 0.0;
  /// Number of lines that meet there.
  int branches = 0;
};

struct JunctionOptions {
  /// Radius of the circle that the lines must reach, px. 3 … 64.
  int radius_px = 10;
  /// A junction has at least this many branches. 3 … 8.
  int least_branches = 3;
  /// Lines are dilated by this many pixels, so that gaps of twice as many, as thinning leaves them at
  /// junctions, count as line. 0 … 8.
  int bridged_px = 1;
  /// Arcs with a gap of less than this angle are one branch: the two edges of a stroke, which dilation joins
  /// in places. Chosen on rings drawn with strokes of 2 to 6 px. 0 … 90 degrees.
  double least_angle_degrees = 30.0;
};
std::vector<Parameter> parameters_of(JunctionOptions& options);

/// The junctions of one-pixel-wide lines (`line` > 0): places whose connected lines reach at least
/// `least_branches` separate arcs of the circle around them. Lines that only pass nearby do not count.
/// Places closer to each other than the radius are one junction. The options must be in their ranges.
std::vector<Junction> find_junctions(const Raster<float>& line, const JunctionOptions& options);

/// A label picture of `line`'s size: `label` in discs of `radius_px` round the junctions, 0 elsewhere.
Raster<std::uint8_t> mark_junctions(const std::vector<Junction>& junctions, int width, int height,
                                    double radius_px, std::uint8_t label);

}  // namespace palpable::sculpt
