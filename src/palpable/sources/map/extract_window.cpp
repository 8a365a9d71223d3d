// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/map/extract_window.hpp"

#include "palpable/core/geometry/map_clip.hpp"
#include "palpable/sources/map/extract_places.hpp"
#include "palpable/sources/map/projection.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace palpable::sources {
namespace {

/// The kinds of streets, and their usual widths.
struct StreetKind {
  std::string_view name;
  double width_m;
  /// Whether it is one without a name, too.
  bool unnamed;
};
constexpr std::array<StreetKind, 16> kStreetKinds{{{"motorway", 12.0, true},
                                                   {"motorway_link", 6.0, true},
                                                   {"trunk", 11.0, true},
                                                   {"trunk_link", 6.0, true},
                                                   {"primary", 10.0, true},
                                                   {"primary_link", 6.0, true},
                                                   {"secondary", 9.0, true},
                                                   {"secondary_link", 6.0, true},
                                                   {"tertiary", 8.0, true},
                                                   {"tertiary_link", 6.0, true},
                                                   {"unclassified", 6.0, true},
                                                   {"residential", 6.0, true},
                                                   {"living_street", 5.0, true},
                                                   {"road", 6.0, true},
                                                   {"pedestrian", 5.0, false},
                                                   {"service", 4.0, false}}};

constexpr std::string_view kSidewalk = "sidewalk", kSteps = "steps";

MapStreet::Kind kind_of(const ExtractWay& way) {
  if (way.kind == kSidewalk) return MapStreet::Kind::sidewalk;
  return way.kind == kSteps ? MapStreet::Kind::steps : MapStreet::Kind::street;
}

/// A piece of a street between two nodes of the network.
struct StreetPiece {
  const ExtractWay* way;
  std::vector<std::int64_t> nodes;
  std::vector<GeoPoint> points;
};

/// How many pieces of streets begin at each node.
std::map<std::int64_t, int> ends_at_nodes(const std::vector<const ExtractWay*>& streets) {
  std::map<std::int64_t, int> ends;
  for (const ExtractWay* way : streets)
    for (std::size_t i = 0; i < way->nodes.size(); ++i)
      ends[way->nodes[i]] += i > 0 && i + 1 < way->nodes.size() ? 2 : 1;
  return ends;
}

std::vector<StreetPiece> pieces_of(const std::vector<const ExtractWay*>& streets,
                                   const std::map<std::int64_t, int>& ends) {
  std::vector<StreetPiece> pieces;
  for (const ExtractWay* way : streets) {
    StreetPiece piece{way, {}, {}};
    for (std::size_t i = 0; i < way->nodes.size(); ++i) {
      piece.nodes.push_back(way->nodes[i]);
      piece.points.push_back(way->points[i]);
      const bool is_last = i + 1 == way->nodes.size();
      if (piece.nodes.size() < 2 || (!is_last && ends.at(way->nodes[i]) < 3)) continue;
      pieces.push_back(std::exchange(piece, {way, {way->nodes[i]}, {way->points[i]}}));
    }
  }
  return pieces;
}

/// Joins pieces with one name that meet where no other street is: extracts divide streets at bridges, speed
/// limits and so on.
void join_pieces(std::vector<StreetPiece>& pieces, const std::map<std::int64_t, int>& ends) {
  std::multimap<std::int64_t, std::size_t> at;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (const std::int64_t node : {pieces[i].nodes.front(), pieces[i].nodes.back()})
      if (ends.at(node) == 2) at.emplace(node, i);
  std::vector<std::size_t> moved_to(pieces.size());
  for (std::size_t i = 0; i < moved_to.size(); ++i) moved_to[i] = i;
  const auto where = [&moved_to](std::size_t i) {
    while (moved_to[i] != i) i = moved_to[i];
    return i;
  };
  const auto reverse = [](StreetPiece& p) {
    std::reverse(p.nodes.begin(), p.nodes.end());
    std::reverse(p.points.begin(), p.points.end());
  };
  for (auto it = at.begin(); it != at.end();) {
    const auto [begin, end] = at.equal_range(it->first);
    const std::int64_t node = it->first;
    it = end;
    if (std::distance(begin, end) != 2) continue;
    const std::size_t first = where(begin->second);
    const std::size_t second = where(std::next(begin)->second);
    StreetPiece& a = pieces[first];
    StreetPiece& b = pieces[second];
    if (first == second || a.way->name != b.way->name || kind_of(*a.way) != kind_of(*b.way) ||
        width_m_of(*a.way) != width_m_of(*b.way))
      continue;
    if (a.nodes.back() != node) reverse(a);
    if (b.nodes.front() != node) reverse(b);
    a.nodes.insert(a.nodes.end(), b.nodes.begin() + 1, b.nodes.end());
    a.points.insert(a.points.end(), b.points.begin() + 1, b.points.end());
    b.nodes.clear();
    moved_to[second] = first;
  }
  std::erase_if(pieces, [](const StreetPiece& p) { return p.nodes.empty(); });
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The place of a street that is nearest to the median of all of them.
GeoPoint middle_of(const std::vector<GeoPoint>& places) {
  std::vector<double> latitudes, longitudes;
  for (const GeoPoint& p : places) {
    latitudes.push_back(p.latitude);
    longitudes.push_back(p.longitude);
  }
  const GeoPoint median{median_of(std::move(latitudes)), median_of(std::move(longitudes))};
  const double shrink = std::cos(median.latitude * std::numbers::pi / 180.0);
  const auto far = [&](const GeoPoint& p) {
    return std::hypot(p.latitude - median.latitude, shrink * (p.longitude - median.longitude));
  };
  return *std::min_element(places.begin(), places.end(),
                           [&far](const GeoPoint& a, const GeoPoint& b) { return far(a) < far(b); });
}

/// The window's centre; in the extract.
Result<GeoPoint> center_of(const std::vector<const ExtractWay*>& streets, const ExtractWindow& window) {
  // Without a step at the date line.
  const double first = streets.front()->points.front().longitude;
  std::vector<GeoPoint> places;
  for (const ExtractWay* way : streets)
    for (const GeoPoint& p : way->points) places.push_back({p.latitude, first + east_of(p.longitude, first)});
  if (!window.center) return middle_of(places);
  const auto [south, north] =
      std::minmax_element(places.begin(), places.end(),
                          [](const GeoPoint& a, const GeoPoint& b) { return a.latitude < b.latitude; });
  const auto [west, east] =
      std::minmax_element(places.begin(), places.end(),
                          [](const GeoPoint& a, const GeoPoint& b) { return a.longitude < b.longitude; });
  const GeoPoint c{window.center->latitude, first + east_of(window.center->longitude, first)};
  if (c.latitude >= south->latitude && c.latitude <= north->latitude && c.longitude >= west->longitude &&
      c.longitude <= east->longitude)
    return c;
  return Error{ErrorCode::usage,
               fmt::format("the centre {:.5f},{:.5f} is outside this extract, whose streets reach from "
                           "{:.5f},{:.5f} to {:.5f},{:.5f}",
                           window.center->latitude, window.center->longitude, south->latitude,
                           west->longitude, north->latitude, east->longitude),
               {}};
}

void add_streets(StreetMap& map, std::vector<const ExtractWay*> streets, const Projection& project,
                 double px_per_m) {
  const auto ends = ends_at_nodes(streets);
  std::vector<StreetPiece> pieces = pieces_of(streets, ends);
  join_pieces(pieces, ends);
  const double most = map.width_px - 1;
  std::set<std::int64_t> roundabout;
  for (const ExtractWay* way : streets)
    if (way->roundabout) roundabout.insert(way->nodes.begin(), way->nodes.end());
  std::map<std::int64_t, MapPoint> junctions;
  for (const StreetPiece& piece : pieces) {
    std::vector<MapPoint> line;
    for (const GeoPoint& p : piece.points) line.push_back(project(p));
    for (const bool last : {false, true}) {
      const std::int64_t node = last ? piece.nodes.back() : piece.nodes.front();
      if (ends.at(node) > 2) junctions[node] = last ? line.back() : line.front();
    }
    for (auto& part : parts_in_window(line, {most, most}))
      map.streets.push_back(
          {piece.way->name, width_m_of(*piece.way) * px_per_m, std::move(part), true, kind_of(*piece.way)});
  }
  for (const auto& [node, at] : junctions)
    if (at.x >= 0.0 && at.y >= 0.0 && at.x <= most && at.y <= most)
      map.junctions.push_back({at, ends.at(node), roundabout.contains(node)});
}

void add_areas(StreetMap& map, const MapExtract& extract, const Projection& project) {
  for (const ExtractArea& area : extract.areas) {
    std::vector<MapPoint> ring;
    for (const GeoPoint& p : area.ring) ring.push_back(project(p));
    ring = ring_in_window(std::move(ring), {map.width_px - 1.0, map.height_px - 1.0});
    if (ring.size() < 3) continue;
    const auto kind = area.kind == ExtractArea::Kind::building ? MapArea::Kind::building
                      : area.kind == ExtractArea::Kind::water  ? MapArea::Kind::water
                                                               : MapArea::Kind::green;
    map.areas.push_back({kind, std::move(ring)});
  }
}

Result<void> check(const ExtractWindow& window) {
  constexpr double kLeast_m = 50.0, kMost_m = 20000.0, kNorthernmost = 85.0;
  if (!(window.width_m >= kLeast_m && window.width_m <= kMost_m))
    return Error{ErrorCode::usage, "the width of a map's window is 50 to 20000 m", {}};
  if (window.side_px < 64 || window.side_px > 8192)
    return Error{ErrorCode::usage, "a map's window has 64 to 8192 pixels on a side", {}};
  if (window.center &&
      !(std::abs(window.center->latitude) <= kNorthernmost && std::abs(window.center->longitude) <= 180.0))
    return Error{ErrorCode::usage, "the centre of a map is LATITUDE,LONGITUDE: -85 to 85, -180 to 180", {}};
  return {};
}

}  // namespace

ExtractLayers usual_layers(double width_m) {
  constexpr double kQuarter_m = 1000.0, kPlace_m = 300.0;
  ExtractLayers layers;
  layers.stops = width_m <= kQuarter_m;
  layers.crossings = layers.steps = width_m <= kPlace_m;
  return layers;
}

bool is_street(const ExtractWay& way, const ExtractLayers& layers) {
  if (way.kind == kSidewalk) return layers.sidewalks;
  if (way.kind == kSteps) return layers.steps;
  const auto kind = std::find_if(kStreetKinds.begin(), kStreetKinds.end(),
                                 [&way](const StreetKind& k) { return k.name == way.kind; });
  return kind != kStreetKinds.end() && (kind->unnamed || !way.name.empty());
}

double width_m_of(const ExtractWay& way) {
  if (way.width_m > 0.0) return way.width_m;
  constexpr double kNarrow_m = 3.0;
  for (const StreetKind& kind : kStreetKinds)
    if (kind.name == way.kind) return kind.width_m;
  return kNarrow_m;
}

Result<WindowMap> street_map_of(const MapExtract& extract, const ExtractWindow& window) {
  if (auto checked = check(window); !checked) return checked.error();
  const ExtractLayers layers = window.layers.value_or(usual_layers(window.width_m));
  std::vector<const ExtractWay*> streets;
  for (const ExtractWay& way : extract.ways)
    if (is_street(way, layers)) streets.push_back(&way);
  if (streets.empty()) return invalid_input("is an extract without streets");
  const auto center = center_of(streets, window);
  if (!center) return center.error();
  const Projection project(*center, window);
  WindowMap out;
  out.map.width_px = out.map.height_px = window.side_px;
  out.map.metres_per_px = window.width_m / window.side_px;
  add_streets(out.map, streets, project, window.side_px / window.width_m);
  if (out.map.streets.empty())
    return invalid_input(fmt::format("has no streets in the {:.0f} m around {:.5f},{:.5f}", window.width_m,
                                     center->latitude, center->longitude));
  // The densest cities have a tenth of this in the widest window.
  constexpr std::size_t kMostStreets = 200'000;
  if (out.map.streets.size() > kMostStreets)
    return invalid_input(fmt::format("is damaged, or its window is too wide: it has {} streets in {:.0f} m",
                                     out.map.streets.size(), window.width_m));
  add_areas(out.map, extract, project);
  add_places(out.map, extract, layers, project);
  if (!window.center)
    out.notes.emplace_back(fmt::format("The map shows {:.0f} m around {:.5f},{:.5f}.", window.width_m,
                                       center->latitude, center->longitude),
                           Reason::map_part_chosen);
  return out;
}

}  // namespace palpable::sources
