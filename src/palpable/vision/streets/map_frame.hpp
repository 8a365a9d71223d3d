// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/picture/image.hpp"

#include <vector>

namespace palpable::vision {

struct MapFrameOptions {
  /// Largest difference, in one channel (0 ... 255), between pixels of the page around a map.
  int page_tolerance = 12;
  /// At least this part of the picture outside of the map has the page's colour.
  double least_page_part = 0.98;
  /// At least this part of each side of the map differs from the page, just inside.
  double least_side_part = 0.5;
  /// A page covers at least this part of the picture.
  double least_outside_part = 0.03;
  /// The frame lies this far inside the map's edge, pixels.
  double inset_px = 2.0;
};

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
