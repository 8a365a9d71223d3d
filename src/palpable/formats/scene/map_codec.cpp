// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/scene/map_codec.hpp"

#include "palpable/core/files/byte_reader.hpp"
#include "palpable/core/geometry/map_place.hpp"
#include "palpable/core/text/json_integer.hpp"
#include "palpable/core/text/plain_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

namespace palpable::formats {
namespace {

constexpr std::size_t kMostMapParts = 100000;
constexpr double kFarthest_px = 1e6;

constexpr std::array<std::pair<MapArea::Kind, const char*>, 3> kAreaLists{
    {{MapArea::Kind::building, "buildings"},
     {MapArea::Kind::water, "waters"},
     {MapArea::Kind::green, "greens"}}};

/// Of a kind that this version does not know: a street.
MapStreet::Kind street_kind_from(const std::string& name) {
  for (const auto kind : {MapStreet::Kind::sidewalk, MapStreet::Kind::steps, MapStreet::Kind::path})
    if (name == kind_words(kind)) return kind;
  return MapStreet::Kind::street;
}

double hundredths(double value) { return std::round(100.0 * value) / 100.0; }

nlohmann::json points_json(const std::vector<MapPoint>& points) {
  nlohmann::json list = nlohmann::json::array();
  for (const MapPoint p : points) list.push_back({hundredths(p.x), hundredths(p.y)});
  return list;
}

/// Throws nlohmann::json::exception for another shape.
std::vector<MapPoint> points_from(const nlohmann::json& list) {
  std::vector<MapPoint> points;
  for (const nlohmann::json& j : list) {
    const auto p = j.get<std::array<double, 2>>();
    points.push_back({p[0], p[1]});
  }
  return points;
}

/// False also for NaN.
bool is_near(const std::vector<MapPoint>& points) {
  return std::all_of(points.begin(), points.end(), [](MapPoint p) {
    return std::abs(p.x) <= kFarthest_px && std::abs(p.y) <= kFarthest_px;
  });
}

/// Whether every number of the map is in range.
bool is_valid(const StreetMap& map) {
  const auto street = [](const MapStreet& s) {
    return s.points.size() > 1 && is_near(s.points) && s.width_px >= 0.0 && s.width_px <= kFarthest_px;
  };
  const auto junction = [](const MapJunction& j) { return is_near({j.at}) && j.degree >= 0; };
  const auto area = [](const MapArea& a) { return is_near(a.outline); };
  const auto label = [](const MapLabel& l) {
    return is_near(l.box) && l.confidence >= 0.0 && l.confidence <= 1.0 && std::abs(l.angle_deg) <= 360.0;
  };
  const auto place = [](const MapPlace& p) { return is_near({p.at}) && is_near(p.outline); };
  constexpr double kMostMetres = 1e6;
  return map.width_px > 0 && map.height_px > 0 && map.metres_per_px >= 0.0 &&
         map.metres_per_px <= kMostMetres && map.streets.size() <= kMostMapParts &&
         map.areas.size() <= kMostMapParts && map.places.size() <= kMostMapParts &&
         std::all_of(map.places.begin(), map.places.end(), place) &&
         std::all_of(map.streets.begin(), map.streets.end(), street) &&
         std::all_of(map.junctions.begin(), map.junctions.end(), junction) &&
         std::all_of(map.areas.begin(), map.areas.end(), area) &&
         std::all_of(map.labels.begin(), map.labels.end(), label);
}

Result<StreetMap> map_from(const nlohmann::json& j) {
  StreetMap map;
  map.width_px = integer_from<int>(j.at("width_px"));
  map.height_px = integer_from<int>(j.at("height_px"));
  map.metres_per_px = j.value("metres_per_px", 0.0);
  for (const nlohmann::json& s : j.at("streets"))
    map.streets.push_back({plain_name(s.value("name", std::string())), s.at("width_px").get<double>(),
                           points_from(s.at("points_px")), s.value("felt", true),
                           street_kind_from(s.value("kind", std::string()))});
  for (const nlohmann::json& c : j.at("crossings"))
    map.junctions.push_back({{c.at("x_px").get<double>(), c.at("y_px").get<double>()},
                             integer_from<int>(c.at("degree")),
                             c.value("roundabout", false)});
  for (const auto& [kind, key] : kAreaLists)
    for (const nlohmann::json& a : j.at(key)) map.areas.push_back({kind, points_from(a.at("outline_px"))});
  for (const nlohmann::json& l : j.at("labels"))
    map.labels.push_back({plain_name(l.at("text").get<std::string>()), l.at("confidence").get<double>(),
                          l.at("angle_deg").get<double>(), points_from(l.at("box_px")),
                          l.at("names_street").get<bool>()});
  for (const nlohmann::json& p : j.value("special", nlohmann::json::array())) {
    const auto kind = map_place_kind_from(p.at("kind").get<std::string>());
    if (!kind) continue;
    map.places.push_back({*kind,
                          plain_name(p.value("name", std::string())),
                          {p.at("x_px").get<double>(), p.at("y_px").get<double>()},
                          points_from(p.value("outline_px", nlohmann::json::array())),
                          p.value("tactile_paving", false),
                          p.value("felt", true)});
  }
  std::erase_if(map.labels, [](const MapLabel& label) { return label.text.empty(); });
  if (!is_valid(map)) return invalid_input("has a map.json with numbers out of range");
  return map;
}

}  // namespace

nlohmann::json json_of(const StreetMap& map) {
  nlohmann::json j = {{"width_px", map.width_px},
                      {"height_px", map.height_px},
                      {"metres_per_px", map.metres_per_px},
                      {"streets", nlohmann::json::array()},
                      {"crossings", nlohmann::json::array()},
                      {"special", nlohmann::json::array()},
                      {"labels", nlohmann::json::array()}};
  for (const auto& [kind, key] : kAreaLists) j[key] = nlohmann::json::array();
  for (const MapStreet& s : map.streets)
    j["streets"].push_back({{"id", j["streets"].size()},
                            {"name", s.name},
                            {"width_px", hundredths(s.width_px)},
                            {"points_px", points_json(s.points)},
                            {"felt", s.felt},
                            {"kind", kind_words(s.kind)}});
  for (const MapJunction& c : map.junctions)
    j["crossings"].push_back({{"x_px", hundredths(c.at.x)},
                              {"y_px", hundredths(c.at.y)},
                              {"degree", c.degree},
                              {"roundabout", c.roundabout}});
  for (const MapArea& area : map.areas)
    for (const auto& [kind, key] : kAreaLists)
      if (kind == area.kind) j[key].push_back({{"outline_px", points_json(area.outline)}});
  for (const MapPlace& p : map.places) {
    nlohmann::json special = {{"kind", name_of(p.kind)},
                              {"name", p.name},
                              {"x_px", hundredths(p.at.x)},
                              {"y_px", hundredths(p.at.y)},
                              {"felt", p.felt}};
    if (!p.outline.empty()) special["outline_px"] = points_json(p.outline);
    if (p.kind == MapPlace::Kind::crossing) special["tactile_paving"] = p.tactile_paving;
    j["special"].push_back(std::move(special));
  }
  for (const MapLabel& l : map.labels)
    j["labels"].push_back({{"text", l.text},
                           {"confidence", hundredths(l.confidence)},
                           {"angle_deg", hundredths(l.angle_deg)},
                           {"box_px", points_json(l.box)},
                           {"names_street", l.names_street}});
  return j;
}

Bytes encode_street_map(const StreetMap& map) {
  const std::string text = json_of(map).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  const auto bytes = as_bytes(text);
  return {bytes.begin(), bytes.end()};
}

Result<StreetMap> decode_street_map(std::span<const std::byte> file) {
  const nlohmann::json j = nlohmann::json::parse(as_text(file), nullptr, false);
  try {
    return map_from(j);
  } catch (const nlohmann::json::exception&) {
    return invalid_input("has a map.json that is damaged or incomplete");
  }
}

}  // namespace palpable::formats
