// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/map/extract_parser.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/text/number_text.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <osmium/area/assembler.hpp>
#include <osmium/area/multipolygon_manager.hpp>
#include <osmium/handler.hpp>
#include <osmium/handler/node_locations_for_ways.hpp>
#include <osmium/index/map/sparse_mem_array.hpp>
#include <osmium/io/pbf_input.hpp>
#include <osmium/io/xml_input.hpp>
#include <osmium/visitor.hpp>

namespace palpable::sources {
namespace {

using Locations = osmium::index::map::SparseMemArray<osmium::unsigned_object_id_type, osmium::Location>;

std::string_view value_of(const osmium::TagList& tags, const char* key) {
  const char* value = tags.get_value_by_key(key);
  return value != nullptr ? value : std::string_view();
}

/// The kinds of areas by their tags; "*" is every value but "no".
struct AreaTag {
  const char* key;
  const char* value;
  ExtractArea::Kind kind;
};
using Kind = ExtractArea::Kind;
constexpr std::array<AreaTag, 15> kAreaTags{{{"building", "*", Kind::building},
                                             {"natural", "water", Kind::water},
                                             {"waterway", "riverbank", Kind::water},
                                             {"landuse", "reservoir", Kind::water},
                                             {"landuse", "basin", Kind::water},
                                             {"leisure", "park", Kind::green},
                                             {"leisure", "garden", Kind::green},
                                             {"landuse", "grass", Kind::green},
                                             {"landuse", "forest", Kind::green},
                                             {"landuse", "meadow", Kind::green},
                                             {"landuse", "cemetery", Kind::green},
                                             {"landuse", "recreation_ground", Kind::green},
                                             {"natural", "wood", Kind::green},
                                             {"natural", "scrub", Kind::green},
                                             {"natural", "grassland", Kind::green}}};

bool fits(const osmium::TagList& tags, const AreaTag& tag) {
  const std::string_view value = value_of(tags, tag.key);
  if (value.empty() || value == "no") return false;
  return std::string_view(tag.value) == "*" || value == tag.value;
}

/// The kinds of special places by their tags, those of places of worship apart.
struct PlaceTag {
  const char* key;
  const char* value;
  MapPlace::Kind kind;
};
using PlaceKind = MapPlace::Kind;
constexpr std::array<PlaceTag, 30> kPlaceTags{
    {{"building", "church", PlaceKind::church},         {"building", "cathedral", PlaceKind::church},
     {"building", "chapel", PlaceKind::church},         {"building", "mosque", PlaceKind::mosque},
     {"building", "synagogue", PlaceKind::synagogue},   {"building", "temple", PlaceKind::temple},
     {"building", "train_station", PlaceKind::station}, {"railway", "station", PlaceKind::station},
     {"railway", "halt", PlaceKind::station},           {"public_transport", "station", PlaceKind::station},
     {"amenity", "bus_station", PlaceKind::station},    {"amenity", "hospital", PlaceKind::hospital},
     {"healthcare", "hospital", PlaceKind::hospital},   {"building", "hospital", PlaceKind::hospital},
     {"amenity", "school", PlaceKind::school},          {"amenity", "college", PlaceKind::school},
     {"amenity", "university", PlaceKind::school},      {"amenity", "townhall", PlaceKind::town_hall},
     {"tourism", "museum", PlaceKind::museum},          {"amenity", "library", PlaceKind::library},
     {"amenity", "theatre", PlaceKind::theatre},        {"highway", "mini_roundabout", PlaceKind::roundabout},
     {"highway", "bus_stop", PlaceKind::bus_stop},      {"railway", "tram_stop", PlaceKind::tram_stop},
     {"highway", "crossing", PlaceKind::crossing},      {"entrance", "yes", PlaceKind::entrance},
     {"entrance", "main", PlaceKind::entrance},         {"entrance", "service", PlaceKind::entrance},
     {"entrance", "shop", PlaceKind::entrance},         {"entrance", "staircase", PlaceKind::entrance}}};

PlaceKind worship_kind(const osmium::TagList& tags) {
  const std::string_view religion = value_of(tags, "religion");
  if (religion.empty() || religion == "christian") return PlaceKind::church;
  if (religion == "muslim") return PlaceKind::mosque;
  return religion == "jewish" ? PlaceKind::synagogue : PlaceKind::temple;
}

std::optional<PlaceKind> place_kind(const osmium::TagList& tags) {
  if (value_of(tags, "disused") == "yes" || value_of(tags, "abandoned") == "yes") return std::nullopt;
  if (value_of(tags, "amenity") == "place_of_worship") return worship_kind(tags);
  for (const PlaceTag& tag : kPlaceTags)
    if (value_of(tags, tag.key) == tag.value) return tag.kind;
  return std::nullopt;
}

bool has_tactile_paving(const osmium::TagList& tags) {
  const std::string_view paving = value_of(tags, "tactile_paving");
  return !paving.empty() && paving != "no";
}

/// Ways under the ground that are no tunnels for traffic, planned ones and races are no streets.
std::optional<std::string> way_kind(const osmium::TagList& tags) {
  const std::string_view highway = value_of(tags, "highway");
  constexpr std::array<std::string_view, 12> kNone{"proposed",  "construction", "raceway",  "corridor",
                                                   "platform",  "elevator",     "razed",    "abandoned",
                                                   "rest_area", "services",     "bus_stop", "no"};
  if (const std::string_view footway = value_of(tags, "footway");
      highway == "footway" && (footway == "sidewalk" || footway == "crossing"))
    return "sidewalk";
  if (!highway.empty())
    return std::find(kNone.begin(), kNone.end(), highway) == kNone.end() ? std::optional<std::string>(highway)
                                                                         : std::nullopt;
  const std::string_view railway = value_of(tags, "railway");
  if (railway == "rail" || railway == "tram" || railway == "light_rail" || railway == "narrow_gauge")
    return "rail";
  return std::nullopt;
}

/// Metres: a number, which may be followed by "m", "ft" or "'"; 0 for anything else.
double metres_of(std::string_view text) {
  const std::size_t end = std::min(text.find_first_not_of("0123456789."), text.size());
  const auto value = finite_number(text.substr(0, end));
  const std::size_t at = std::min(text.find_first_not_of(' ', end), text.size());
  const std::string_view unit = text.substr(at);
  constexpr double kFoot_m = 0.3048, kWidest_m = 100.0;
  const bool is_feet = unit == "ft" || unit == "'";
  if (!value || (!is_feet && !unit.empty() && unit != "m")) return 0.0;
  const double metres = *value * (is_feet ? kFoot_m : 1.0);
  return metres <= kWidest_m ? metres : 0.0;
}

GeoPoint point_of(const osmium::NodeRef& node) { return {node.location().lat(), node.location().lon()}; }

/// Takes the ways and areas of an extract.
class Collector : public osmium::handler::Handler {
 public:
  void node(const osmium::Node& node) {
    const auto kind = place_kind(node.tags());
    if (!kind || !node.visible() || !node.location().valid()) return;
    extract.places.push_back({*kind,
                              plain_name(value_of(node.tags(), "name")),
                              {node.location().lat(), node.location().lon()},
                              {},
                              has_tactile_paving(node.tags())});
  }

  void way(const osmium::Way& way) {
    if (way.nodes().size() > kMostReferences) longest = std::max(longest, way.nodes().size());
    const osmium::TagList& tags = way.tags();
    auto kind = way_kind(tags);
    if (!kind || !way.visible() || value_of(tags, "area") == "yes") return;
    ExtractWay out;
    out.kind = *std::move(kind);
    out.name = plain_name(value_of(tags, "name"));
    out.width_m = metres_of(value_of(tags, "width"));
    out.tunnel = !value_of(tags, "tunnel").empty() && value_of(tags, "tunnel") != "no";
    const std::string_view junction = value_of(tags, "junction");
    out.roundabout = junction == "roundabout" || junction == "circular";
    for (const osmium::NodeRef& node : way.nodes()) {
      if (node.location().valid()) {
        out.nodes.push_back(node.ref());
        out.points.push_back(point_of(node));
      } else {
        add_part(out);
      }
    }
    add_part(out);
  }

  void area(const osmium::Area& area) {
    if (!area.visible()) return;
    if (const auto kind = place_kind(area.tags())) add_place(area, *kind);
    const auto tag = std::find_if(kAreaTags.begin(), kAreaTags.end(),
                                  [&area](const AreaTag& t) { return fits(area.tags(), t); });
    if (tag == kAreaTags.end()) return;
    for (const osmium::OuterRing& ring : area.outer_rings())
      if (auto points = points_of(ring); points.size() >= 3)
        extract.areas.push_back({tag->kind, std::move(points)});
  }

  /// OpenStreetMap takes ways of 2000 nodes; other programs may write longer ones.
  static constexpr std::size_t kMostReferences = 100'000;

  MapExtract extract;
  /// The number of references of the longest way that has too many; 0 if none has.
  std::size_t longest = 0;

 private:
  static std::vector<GeoPoint> points_of(const osmium::OuterRing& ring) {
    std::vector<GeoPoint> points;
    for (const osmium::NodeRef& node : ring)
      if (node.location().valid()) points.push_back(point_of(node));
    if (!points.empty()) points.pop_back();
    return points;
  }

  /// At the middle of the ring with the most points, which is kept where it is that of a building.
  void add_place(const osmium::Area& area, PlaceKind kind) {
    std::vector<GeoPoint> largest;
    for (const osmium::OuterRing& ring : area.outer_rings())
      if (auto points = points_of(ring); points.size() > largest.size()) largest = std::move(points);
    if (largest.size() < 3) return;
    const auto [south, north] = std::minmax_element(
        largest.begin(), largest.end(), [](GeoPoint a, GeoPoint b) { return a.latitude < b.latitude; });
    const auto [west, east] = std::minmax_element(
        largest.begin(), largest.end(), [](GeoPoint a, GeoPoint b) { return a.longitude < b.longitude; });
    ExtractPlace place{kind,
                       plain_name(value_of(area.tags(), "name")),
                       {0.5 * (south->latitude + north->latitude), 0.5 * (west->longitude + east->longitude)},
                       {},
                       false};
    const std::string_view building = value_of(area.tags(), "building");
    if (!building.empty() && building != "no") place.ring = std::move(largest);
    extract.places.push_back(std::move(place));
  }

  /// A way is divided where the extract lacks a node.
  void add_part(ExtractWay& way) {
    if (way.points.size() >= 2) extract.ways.push_back(way);
    way.nodes.clear();
    way.points.clear();
  }
};

}  // namespace

Result<MapExtract> parse_map_extract(std::span<const std::byte> file) {
  const std::string_view text = as_text(file);
  const bool is_pbf = has_magic(file, "OSMHeader", 6);
  // XML begins with a tag, after a byte order mark and blanks at most.
  const auto begin = text.find_first_not_of(std::string_view("\xEF\xBB\xBF\xFF\xFE\0 \t\r\n", 10));
  if (!is_pbf && (begin == std::string_view::npos || text[begin] != '<'))
    return invalid_input("is not a map extract, which is OSM XML or PBF");
  const osmium::io::File input(text.data(), text.size(), is_pbf ? "pbf" : "osm");
  osmium::TagsFilter filter{false};
  for (const AreaTag& tag : kAreaTags) {
    if (std::string_view(tag.value) == "*")
      filter.add_rule(true, tag.key);
    else
      filter.add_rule(true, tag.key, tag.value);
  }
  for (const PlaceTag& tag : kPlaceTags) filter.add_rule(true, tag.key, tag.value);
  filter.add_rule(true, "amenity", "place_of_worship");
  const osmium::area::Assembler::config_type config;
  osmium::area::MultipolygonManager<osmium::area::Assembler> areas{config, filter};
  osmium::relations::read_relations(input, areas);
  // Editors number new nodes below zero; and some files have their nodes after the ways.
  Locations index, index_below_zero;
  osmium::handler::NodeLocationsForWays<Locations, Locations> locations{index, index_below_zero};
  locations.ignore_errors();
  osmium::io::Reader nodes{input, osmium::osm_entity_bits::node};
  Collector collector;
  osmium::apply(nodes, locations, collector);
  nodes.close();
  osmium::io::Reader reader{input, osmium::osm_entity_bits::way | osmium::osm_entity_bits::relation};
  osmium::apply(reader, locations, collector, areas.handler([&collector](osmium::memory::Buffer&& buffer) {
    osmium::apply(buffer, collector);
  }));
  reader.close();
  if (collector.longest > 0)
    return invalid_input("is damaged: it has a way of " + std::to_string(collector.longest) +
                         " nodes, and OpenStreetMap allows 2000");
  return std::move(collector.extract);
}

}  // namespace palpable::sources
