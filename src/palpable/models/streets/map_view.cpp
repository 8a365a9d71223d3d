// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/streets/map_view.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/geometry/map_clip.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace palpable::models {
namespace {

std::vector<MapPoint> moved(const MapView& view, std::vector<MapPoint> points) {
  for (MapPoint& p : points) p = view.in_part(p);
  return points;
}

}  // namespace

MapView zoomed_about(const StreetMap& map, const MapView& view, MapPoint part, double zoom) {
  PALPABLE_CHECK(zoom >= 1.0);
  const MapPoint place = view.in_whole(part);
  const auto within = [zoom](double corner, int size_px) {
    return std::clamp(corner, 0.0, size_px * (1.0 - 1.0 / zoom));
  };
  return {{within(place.x - part.x / zoom, map.width_px), within(place.y - part.y / zoom, map.height_px)},
          zoom};
}

StreetMap part_of_map(const StreetMap& map, const MapView& view) {
  StreetMap part;
  part.width_px = map.width_px;
  part.height_px = map.height_px;
  part.metres_per_px = map.metres_per_px / view.zoom;
  const MapPoint most{map.width_px - 1.0, map.height_px - 1.0};
  const auto is_inside = [most](MapPoint p) {
    return p.x >= 0.0 && p.y >= 0.0 && p.x <= most.x && p.y <= most.y;
  };
  for (const MapStreet& street : map.streets)
    for (auto& line : parts_in_window(moved(view, street.points), most))
      part.streets.push_back({street.name, street.width_px * view.zoom, std::move(line), true, street.kind});
  for (MapJunction junction : map.junctions) {
    junction.at = view.in_part(junction.at);
    if (is_inside(junction.at)) part.junctions.push_back(junction);
  }
  for (const MapArea& area : map.areas)
    if (auto ring = ring_in_window(moved(view, area.outline), most); ring.size() > 2)
      part.areas.push_back({area.kind, std::move(ring)});
  for (MapLabel label : map.labels) {
    label.box = moved(view, std::move(label.box));
    if (!label.box.empty() && is_inside(label.box.front())) part.labels.push_back(std::move(label));
  }
  for (MapPlace place : map.places) {
    place.at = view.in_part(place.at);
    place.outline = moved(view, std::move(place.outline));
    place.felt = true;
    if (is_inside(place.at)) part.places.push_back(std::move(place));
  }
  return part;
}

}  // namespace palpable::models
