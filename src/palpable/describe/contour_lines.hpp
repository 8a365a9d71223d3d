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

/// One line of a boundary map. Where lines cross, each goes on straight ahead.
struct ContourLine {
  /// Along its middle.
  double length_m = 0.0;
  /// Whether it comes back to its beginning.
  bool closed = false;
  /// The box around it, scene frame.
  Place least, most;
  /// Where it begins and ends; of a closed line, twice the same place.
  Place first, last;
  Place middle() const { return {0.5 * (least.x_m + most.x_m), 0.5 * (least.y_m + most.y_m)}; }
};

/// The lines of a map and how they meet.
struct ContourDrawing {
  /// The longest first.
  std::vector<ContourLine> lines;
  /// Where a line crosses itself or another, or ends on one.
  std::vector<Place> meetings;
  /// Areas with lines all around them.
  std::size_t enclosed_areas = 0;
};

/// Lengths are shares of the map's longer side.
struct ContourLineOptions {
  /// Shorter lines are left out: 5 mm of 100 mm. 0 … 1.
  double least_length = 0.05;
  /// Shorter side branches are left out, as thinning makes them of a thick line's corners; and meetings as
  /// close to each other are one. 0 … 0.1.
  double least_branch = 0.02;
  /// A line goes straight ahead through a meeting if it turns by no more than this. 0 … 90 degrees.
  double greatest_turn_degrees = 40.0;
  /// Smaller areas with a line all around are filled, as the gap in a stroke where two cross; as a share of
  /// the map's area, 10 mm² of 100 x 100 mm. 0 … 0.1.
  double least_area = 1e-3;
};
std::vector<Parameter> parameters_of(ContourLineOptions& options);

/// The drawing that a map's lines make: pixels whose strength reaches the map's threshold, at most 512 along
/// the longer side, thinned to lines (skeleton.hpp). The options must be in their ranges.
ContourDrawing find_contour_lines(const models::BoundaryMap& map, const ContourLineOptions& options = {});

/// How near a place is to a line.
struct NearestLine {
  /// From the place to the line.
  double dx_m = 0.0;
  double dy_m = 0.0;
  /// Angle of the line there, 0 to pi from the x axis towards the y axis; it has no sign.
  double angle_rad = 0.0;
};

/// The nearest place of a line's middle within `reach_m`: a pixel whose strength reaches the map's threshold
/// and is the greatest across the line, to a fraction of a pixel; nullopt where there is none.
std::optional<NearestLine> nearest_line(const models::BoundaryMap& map, Place place, double reach_m);

/// A person who moves in steps of 1 mm is on a line within this distance of it, and cannot step over one.
inline constexpr double kOnLine_m = 0.00075;

}  // namespace palpable::describe
