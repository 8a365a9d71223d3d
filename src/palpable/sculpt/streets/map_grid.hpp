// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/segment.hpp"
#include "palpable/core/geometry/street_map.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::sculpt {

/// From pixels of a map to samples of its relief.
struct MapGrid {
  int columns = 0;
  int rows = 0;
  /// Samples for one pixel of the map, and for one metre on the device.
  double of_pixel = 1.0;
  double of_metre = 1.0;

  /// The place in samples.
  MapPoint at(MapPoint p) const { return {(p.x + 0.5) * of_pixel - 0.5, (p.y + 0.5) * of_pixel - 0.5}; }
};

/// The grid of a map in a rectangle, with this number of samples along its longer side.
inline MapGrid map_grid(const StreetMap& map, double width_m, double height_m, int samples) {
  const double longer = std::max(map.width_px, map.height_px);
  MapGrid grid;
  grid.of_pixel = samples / longer;
  grid.columns = std::max(2, static_cast<int>(std::lround(map.width_px * grid.of_pixel)));
  grid.rows = std::max(2, static_cast<int>(std::lround(map.height_px * grid.of_pixel)));
  grid.of_metre = 1.0 / std::min(width_m / grid.columns, height_m / grid.rows);
  return grid;
}

/// Calls visit(x, y, distance) for the samples within `half` samples of a segment.
template <class Visit>
void near_segment(const MapGrid& grid, MapPoint a, MapPoint b, double half, const Visit& visit) {
  const int left = std::max(0, static_cast<int>(std::min(a.x, b.x) - half));
  const int right = std::min(grid.columns - 1, static_cast<int>(std::max(a.x, b.x) + half) + 1);
  const int top = std::max(0, static_cast<int>(std::min(a.y, b.y) - half));
  const int bottom = std::min(grid.rows - 1, static_cast<int>(std::max(a.y, b.y) + half) + 1);
  for (int y = top; y <= bottom; ++y)
    for (int x = left; x <= right; ++x) {
      const double distance = distance_to_segment(MapPoint{1.0 * x, 1.0 * y}, a, b);
      if (distance < half) visit(x, y, distance);
    }
}

}  // namespace palpable::sculpt
