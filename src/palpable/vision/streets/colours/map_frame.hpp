// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"

#include <vector>

namespace palpable::vision {

struct MapFrameOptions {
  /// Largest difference, in one channel, between pixels of the page around a map, levels. 0 ... 255.
  int page_tolerance = 12;
  /// The page's colour is that of all four places this far inside the picture's corners, pixels. 0 ... 100.
  int page_corner_px = 3;
  /// Gaps of the map in the page's colour (streets) are narrower than this, pixels. 1 ... 200.
  int closing_px = 25;
  /// The map's edge, a mixture of its colours and the page's, is this wide, pixels. 1 ... 50.
  int edge_px = 5;
  /// At least this part of the picture outside of the map has the page's colour. 0 ... 1.
  double least_page_part = 0.98;
  /// At least this part of each side of the map differs from the page, 0 ... 1, this far inside, pixels, 0
  /// ... 50.
  double least_side_part = 0.5;
  double side_inside_px = 4.0;
  /// A page covers at least this part of the picture. 0 ... 1.
  double least_outside_part = 0.03;
  /// The frame lies this far inside the map's edge, pixels. 0 ... 50.
  double inset_px = 2.0;
};
std::vector<Parameter> parameters_of(MapFrameOptions& options);

/// The part of a picture that is the map: a rectangle in any direction.
struct MapFrame {
  /// In order around it.
  std::vector<MapPoint> corners;
  /// Whether there is a page around it.
  bool on_page = false;
};

/// Finds the map on a page of one colour, also where it is turned; without a page the frame is the picture's.
/// Any thread.
MapFrame find_map_frame(const Raster<Rgb8>& picture, const MapFrameOptions& options = {});

/// Distance from a point inside a frame to its nearest side, pixels; negative outside.
double distance_to_side(const MapFrame& frame, MapPoint p);

/// Distance from a point inside a frame to its side in a direction of length 1, pixels.
double distance_to_side(const MapFrame& frame, MapPoint p, MapPoint direction);

}  // namespace palpable::vision
