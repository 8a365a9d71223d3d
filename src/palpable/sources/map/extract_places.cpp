// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/map/extract_places.hpp"

#include "palpable/core/geometry/map_place.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace palpable::sources {
namespace {

using PlaceKind = MapPlace::Kind;

bool is_asked_for(PlaceKind kind, const ExtractLayers& layers) {
  if (kind == PlaceKind::crossing) return layers.crossings;
  if (kind == PlaceKind::entrance) return layers.entrances;
  if (kind == PlaceKind::bus_stop || kind == PlaceKind::tram_stop) return layers.stops;
  return true;
}

/// Whether a point is inside of a ring (crossings of a ray).
bool is_inside(MapPoint p, const std::vector<MapPoint>& ring) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y > p.y) != (ring[j].y > p.y) &&
        p.x < (ring[j].x - ring[i].x) * (p.y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x)
      inside = !inside;
  return inside;
}

/// How far apart two places of a kind are one, metres.
double same_m(PlaceKind kind) {
  constexpr double kBuilding_m = 60.0, kStop_m = 40.0, kCrossing_m = 12.0, kEntrance_m = 3.0;
  if (kind == PlaceKind::station) return 2.0 * kBuilding_m;
  if (kind == PlaceKind::crossing) return kCrossing_m;
  if (kind == PlaceKind::entrance) return kEntrance_m;
  return kind == PlaceKind::bus_stop || kind == PlaceKind::tram_stop ? kStop_m : kBuilding_m;
}

/// Adds a place, or what it tells more of one that is there.
void add_place(StreetMap& map, MapPlace place) {
  const double same_px = same_m(place.kind) / map.metres_per_px;
  for (MapPlace& known : map.places) {
    const bool is_same = known.kind == place.kind &&
                         (known.name == place.name || known.name.empty() || place.name.empty()) &&
                         std::hypot(known.at.x - place.at.x, known.at.y - place.at.y) <= same_px;
    if (!is_same) continue;
    if (known.name.empty()) known.name = std::move(place.name);
    if (known.outline.empty() && !place.outline.empty()) {
      known.outline = std::move(place.outline);
      known.at = place.at;
    }
    known.tactile_paving = known.tactile_paving || place.tactile_paving;
    return;
  }
  map.places.push_back(std::move(place));
}

/// The rings of ways that share nodes, as the numbers of those of `extract`.
std::vector<std::vector<const ExtractWay*>> rings_of(const MapExtract& extract) {
  std::vector<std::vector<const ExtractWay*>> rings;
  std::vector<std::set<std::int64_t>> nodes;
  for (const ExtractWay& way : extract.ways) {
    if (!way.roundabout) continue;
    std::vector<const ExtractWay*> ring{&way};
    std::set<std::int64_t> of_ring(way.nodes.begin(), way.nodes.end());
    for (std::size_t k = rings.size(); k-- > 0;) {
      const bool meets = std::any_of(nodes[k].begin(), nodes[k].end(),
                                     [&of_ring](std::int64_t node) { return of_ring.contains(node); });
      if (!meets) continue;
      ring.insert(ring.end(), rings[k].begin(), rings[k].end());
      of_ring.insert(nodes[k].begin(), nodes[k].end());
      rings.erase(rings.begin() + static_cast<std::ptrdiff_t>(k));
      nodes.erase(nodes.begin() + static_cast<std::ptrdiff_t>(k));
    }
    rings.push_back(std::move(ring));
    nodes.push_back(std::move(of_ring));
  }
  return rings;
}

/// The name of a ring that is not that of a street that leads to it.
std::string own_name(const std::vector<const ExtractWay*>& ring, const MapExtract& extract) {
  const std::string& name = ring.front()->name;
  for (const ExtractWay& way : extract.ways)
    if (!way.roundabout && way.name == name) return {};
  return name;
}

void add_roundabouts(StreetMap& map, const MapExtract& extract, const Projection& project) {
  for (const auto& ring : rings_of(extract)) {
    MapPlace place;
    place.kind = PlaceKind::roundabout;
    std::vector<MapPoint> points;
    for (const ExtractWay* way : ring)
      for (const GeoPoint& p : way->points) points.push_back(project(p));
    const auto count = static_cast<double>(points.size());
    for (const MapPoint p : points) place.at = {place.at.x + p.x / count, place.at.y + p.y / count};
    // Around its middle: a roundabout is convex.
    std::sort(points.begin(), points.end(), [&](MapPoint a, MapPoint b) {
      return std::atan2(a.y - place.at.y, a.x - place.at.x) < std::atan2(b.y - place.at.y, b.x - place.at.x);
    });
    if (place.at.x < 0.0 || place.at.y < 0.0 || place.at.x > map.width_px - 1 ||
        place.at.y > map.height_px - 1)
      continue;
    place.outline = std::move(points);
    place.name = own_name(ring, extract);
    map.places.push_back(std::move(place));
  }
}

}  // namespace

void add_places(StreetMap& map, const MapExtract& extract, const ExtractLayers& layers,
                const Projection& project) {
  add_roundabouts(map, extract, project);
  for (const ExtractPlace& found : extract.places) {
    if (!is_asked_for(found.kind, layers)) continue;
    MapPlace place;
    place.kind = found.kind;
    place.name = found.name;
    place.at = project(found.at);
    place.tactile_paving = found.kind == PlaceKind::crossing && found.tactile_paving;
    if (place.at.x < 0.0 || place.at.y < 0.0 || place.at.x > map.width_px - 1 ||
        place.at.y > map.height_px - 1)
      continue;
    for (const GeoPoint& p : found.ring) place.outline.push_back(project(p));
    if (place.outline.empty() && is_special_building(place.kind))
      for (const MapArea& area : map.areas)
        if (area.kind == MapArea::Kind::building && is_inside(place.at, area.outline)) {
          place.outline = area.outline;
          break;
        }
    add_place(map, std::move(place));
  }
}

}  // namespace palpable::sources
