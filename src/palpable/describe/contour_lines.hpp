// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/describe/peaks.hpp"
#include "palpable/models/contours/boundary_map.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace palpable::describe {

/// One connected line of a boundary map.
struct ContourLine {
  /// Along its middle.
  double length_m = 0.0;
  /// Whether it encloses an area.
  bool closed = false;
  /// The box around it, scene frame.
  Place least, most;
  Place middle() const { return {0.5 * (least.x_m + most.x_m), 0.5 * (least.y_m + most.y_m)}; }
};

struct ContourLineOptions {
  /// Shorter lines are left out, as a share of the map's longer side: 5 mm of 100 mm.
  double least_length = 0.05;
};

/// The lines of a map: pixels whose strength reaches the map's threshold, at most 512 along the longer side,
/// thinned (Zhang & Suen 1984) and connected over eight neighbours. The longest first.
std::vector<ContourLine> find_contour_lines(const models::BoundaryMap& map,
                                            const ContourLineOptions& options = {});

/// How near a place is to a line.
struct NearestLine {
  /// From the place to the line.
  double dx_m = 0.0;
  double dy_m = 0.0;
  /// Angle of the line there, 0 to pi from the x axis towards the y axis; it has no sign.
  double angle_rad = 0.0;
};

/// The nearest pixel whose strength reaches the map's threshold, within `reach_m`; nullopt where there is
/// none.
std::optional<NearestLine> nearest_line(const models::BoundaryMap& map, Place place, double reach_m);

/// A person who moves in steps of 1 mm is on a line within this distance of it, and cannot step over one.
inline constexpr double kOnLine_m = 0.00075;

}  // namespace palpable::describe
