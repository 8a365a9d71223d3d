// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/describe/peaks.hpp"
#include "palpable/models/contours/boundary_map.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace palpable::describe {

/// One line of a boundary map. At a crossing each line continues straight ahead.
struct ContourLine {
  /// Length of its centre line.
  double length_m = 0.0;
  /// Whether it returns to its start.
  bool closed = false;
  /// Corners of its bounding box, scene frame.
  Place least, most;
  /// Start and end; equal if the line is closed.
  Place first, last;
  /// Its centre line, from the first place to the last one; of a closed line without repeating the first.
  std::vector<Place> points;
  Place middle() const { return {0.5 * (least.x_m + most.x_m), 0.5 * (least.y_m + most.y_m)}; }
};

/// The lines of a map and their junctions.
struct ContourDrawing {
  /// Sorted by length, the longest first.
  std::vector<ContourLine> lines;
  /// Points where a line crosses itself or another line, or ends on one.
  std::vector<Place> junctions;
  /// Number of areas enclosed by lines.
  std::size_t enclosed_areas = 0;
};

/// Lengths are fractions of the map's longer side.
struct ContourLineOptions {
  /// Shorter lines are ignored. 0 … 1; the default is 5 mm of 100 mm.
  double least_length = 0.05;
  /// Shorter side branches are removed: thinning creates them at the corners of a thick line. Junctions
  /// closer than this are merged. 0 … 0.1.
  double least_branch = 0.02;
  /// Largest turn of a line that continues through a junction. 0 … 90 degrees.
  double greatest_turn_degrees = 40.0;
  /// Smaller enclosed areas are filled, e.g. a gap in a stroke at a crossing. Fraction of the map's area, 0 …
  /// 0.1; the default is 10 mm² of 100 x 100 mm.
  double least_area = 1e-3;
  /// Slits of up to twice this width are closed: a stroke that is drawn with a pen has an edge on each side.
  /// 0 … 0.02; the default closes 0.5 mm of 100 mm, and leaves gaps that a finger can find.
  double closing = 0.0025;
};
std::vector<Parameter> parameters_of(ContourLineOptions& options);

/// The lines of a map: its pixels of at least the map's threshold, reduced to at most 512 along the longer
/// side and thinned to lines (skeleton.hpp). The options must be in their ranges.
ContourDrawing find_contour_lines(const models::BoundaryMap& map, const ContourLineOptions& options = {});

/// Offset from a place to the nearest line.
struct NearestLine {
  /// From the place to the line, scene frame.
  double dx_m = 0.0;
  double dy_m = 0.0;
  /// Orientation of the line there, modulo pi: 0 to pi from the x axis towards the y axis.
  double angle_rad = 0.0;
};

/// The nearest point of a centre line within `reach_m`, to a fraction of a pixel; nullopt if there is none.
/// The centre line consists of the pixels of at least the map's threshold whose strength is maximal across
/// the line.
std::optional<NearestLine> nearest_line(const models::BoundaryMap& map, Place place, double reach_m);

/// Within this distance the probe is on the line. A user who moves in steps of 1 mm cannot step over a
/// line.
inline constexpr double kOnLine_m = 0.00075;

}  // namespace palpable::describe
