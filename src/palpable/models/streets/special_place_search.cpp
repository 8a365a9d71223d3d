// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/streets/special_place_search.hpp"

#include "palpable/core/check.hpp"
#include "palpable/core/geometry/map_place.hpp"
#include "palpable/models/streets/street_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

namespace palpable::models {
namespace {

/// A piece in one of its two directions.
using Directed = std::pair<std::size_t, bool>;

/// Twice the area of a ring, positive clockwise (y is down).
double twice_area(const std::vector<MapPoint>& ring) {
  double sum = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapPoint a = ring[i], b = ring[(i + 1) % ring.size()];
    sum += a.x * b.y - b.x * a.y;
  }
  return sum;
}

/// A ring of streets with nothing inside.
struct StreetRing {
  std::vector<MapPoint> line;
  std::vector<std::size_t> nodes;
  double width_px = 0.0;
};

/// The piece that follows clockwise at the end of a directed piece: with it the ring has nothing between.
std::optional<Directed> next_piece(const StreetNetwork& network, Directed arriving) {
  const auto [piece, forward] = arriving;
  const StreetNode& node = network.nodes()[forward ? network.last_node(piece) : network.first_node(piece)];
  const auto here = std::find(node.pieces.begin(), node.pieces.end(), piece);
  if (here == node.pieces.end() || node.pieces.size() < 2) return std::nullopt;
  const auto k = static_cast<std::size_t>(here - node.pieces.begin());
  const std::size_t next = node.pieces[(k + 1) % node.pieces.size()];
  const std::size_t at = forward ? network.last_node(piece) : network.first_node(piece);
  return Directed{next, network.first_node(next) == at};
}

/// The ring on one side of a directed piece, of at most a dozen pieces.
std::optional<StreetRing> ring_from(const StreetNetwork& network, Directed begin) {
  constexpr std::size_t kMostPieces = 12;
  StreetRing ring;
  Directed at = begin;
  for (std::size_t count = 0; count < kMostPieces; ++count) {
    const auto [piece, forward] = at;
    if (network.first_node(piece) == network.last_node(piece) && at != begin) return std::nullopt;
    std::vector<MapPoint> line = network.map().streets[piece].points;
    if (!forward) std::reverse(line.begin(), line.end());
    ring.line.insert(ring.line.end(), line.begin(), line.end() - 1);
    ring.nodes.push_back(forward ? network.first_node(piece) : network.last_node(piece));
    ring.width_px = std::max(ring.width_px, network.map().streets[piece].width_px);
    if (network.first_node(piece) == network.last_node(piece)) return ring;
    const auto next = next_piece(network, at);
    if (!next) return std::nullopt;
    if (*next == begin) return ring;
    at = *next;
  }
  return std::nullopt;
}

bool is_roundabout(const StreetRing& ring, const SpecialPlaceSearchOptions& options) {
  std::vector<MapPoint> closed = ring.line;
  closed.push_back(ring.line.front());
  const double length = length_px_of(closed), area = 0.5 * std::abs(twice_area(ring.line));
  if (!(length > 0.0) || 4.0 * std::numbers::pi * area < options.least_roundness * length * length)
    return false;
  const double diameter = 2.0 * std::sqrt(area / std::numbers::pi);
  return diameter >= options.least_diameter * ring.width_px &&
         diameter <= options.most_diameter * ring.width_px;
}

MapPoint middle_of_points(const std::vector<MapPoint>& points) {
  MapPoint middle;
  const auto count = static_cast<double>(points.size());
  for (const MapPoint p : points) middle = {middle.x + p.x / count, middle.y + p.y / count};
  return middle;
}

void add_roundabouts_by_shape(StreetMap& map, const SpecialPlaceSearchOptions& options) {
  const StreetNetwork network(std::make_shared<const StreetMap>(map));
  std::set<std::vector<std::size_t>> known;
  for (std::size_t piece = 0; piece < map.streets.size(); ++piece)
    for (const bool forward : {true, false}) {
      const auto ring = ring_from(network, {piece, forward});
      if (!ring || !is_roundabout(*ring, options)) continue;
      std::vector<std::size_t> nodes = ring->nodes;
      std::sort(nodes.begin(), nodes.end());
      if (!known.insert(nodes).second) continue;
      MapPlace place;
      place.kind = MapPlace::Kind::roundabout;
      place.at = middle_of_points(ring->line);
      place.outline = ring->line;
      map.places.push_back(std::move(place));
      constexpr double kSame_px = 2.0;
      for (MapJunction& junction : map.junctions)
        for (const std::size_t node : nodes)
          if (std::hypot(network.nodes()[node].at.x - junction.at.x,
                         network.nodes()[node].at.y - junction.at.y) <= kSame_px)
            junction.roundabout = true;
    }
}

/// The building at a place, or the nearest one within reach; null if there is none.
const MapArea* building_at(const StreetMap& map, MapPoint at, double reach_px) {
  const MapArea* best = nullptr;
  double least = reach_px;
  for (const MapArea& area : map.areas) {
    if (area.kind != MapArea::Kind::building || area.outline.size() < 3) continue;
    std::vector<MapPoint> ring = area.outline;
    ring.push_back(ring.front());
    const MapPoint p = nearest_on(ring, at);
    const double distance = std::hypot(p.x - at.x, p.y - at.y);
    if (distance > least) continue;
    least = distance;
    best = &area;
  }
  return best;
}

void add_places_by_words(StreetMap& map, const SpecialPlaceSearchOptions& options) {
  for (const MapLabel& label : map.labels) {
    if (label.names_street || label.box.size() < 4) continue;
    const auto kind = map_place_kind_in(label.text);
    if (!kind) continue;
    MapPlace place;
    place.kind = *kind;
    place.name = label.text;
    place.at = middle_of_points(label.box);
    const double height = std::hypot(label.box[3].x - label.box[0].x, label.box[3].y - label.box[0].y);
    if (const MapArea* building = building_at(map, place.at, options.label_reach * height)) {
      place.outline = building->outline;
      place.at = middle_of_points(place.outline);
    }
    map.places.push_back(std::move(place));
  }
}

}  // namespace

std::vector<Parameter> parameters_of(SpecialPlaceSearchOptions& o) {
  return {
      {"least_roundness", &o.least_roundness, {0.5, 1}, "", "of a roundabout; that of a square is 0.785"},
      {"least_diameter", &o.least_diameter, {0.5, 10}, "", "of a roundabout, in widths of its streets"},
      {"most_diameter", &o.most_diameter, {1, 50}, "", "of a roundabout, in widths of its streets"},
      {"label_reach", &o.label_reach, {0, 20}, "", "from words to their building, in heights of the words"}};
}

void add_special_places(StreetMap& map, const SpecialPlaceSearchOptions& options) {
  PALPABLE_CHECK(check_ranges(options));
  add_places_by_words(map, options);
  if (!map.streets.empty()) add_roundabouts_by_shape(map, options);
}

}  // namespace palpable::models
