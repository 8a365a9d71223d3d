// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"

namespace palpable::models {

/// Which part of a map is shown: the rectangle whose upper left corner is this pixel of the whole map, and
/// whose sides are those of the map divided by `zoom`, which is at least 1.
struct MapView {
  MapPoint corner;
  double zoom = 1.0;

  /// From pixels of the whole map to those of the part, and back.
  MapPoint in_part(MapPoint whole) const {
    return {(whole.x - corner.x) * zoom, (whole.y - corner.y) * zoom};
  }
  MapPoint in_whole(MapPoint part) const { return {corner.x + part.x / zoom, corner.y + part.y / zoom}; }
};

/// The view at another zoom in which the same place of the map is under a pixel of the part. At the map's
/// edges the place moves, since nothing is shown beyond them. `map`: the whole one; `zoom` at least 1.
MapView zoomed_about(const StreetMap& map, const MapView& view, MapPoint part, double zoom);

/// The part of a map as a map of the same size in pixels; streets and areas are cut at its edges, streets are
/// felt again until they are chosen anew.
StreetMap part_of_map(const StreetMap& map, const MapView& view);

}  // namespace palpable::models
