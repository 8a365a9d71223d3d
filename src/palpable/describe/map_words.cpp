// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_words.hpp"

#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"
#include "palpable/describe/place_words.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

/// Two carriageways are at most this far apart: metres of the world, or pixels where the scale is unknown.
constexpr double kCarriageways_m = 30.0;
constexpr double kCarriageways_px = 16.0;

double beside_px(const StreetMap& map) {
  return map.metres_per_px > 0.0 ? kCarriageways_m / map.metres_per_px : kCarriageways_px;
}

}  // namespace

std::string called(const std::string& name, MapStreet::Kind kind) {
  if (!name.empty()) return name;
  if (kind == MapStreet::Kind::steps) return tr("steps");
  if (kind == MapStreet::Kind::path) return tr("a path");
  return kind == MapStreet::Kind::sidewalk ? tr("a sidewalk") : tr(kUnnamedStreet);
}

MapGuide::MapGuide(const models::Scene& scene, MapStreets streets)
    : network_(streets == MapStreets::all ? scene.map : models::felt_part(*scene.map)),
      scene_m_per_px_(models::size_m(scene).x / std::max(1, scene.map->width_px)),
      written_(scene.names),
      streets_(network_.named_streets(beside_px(*scene.map))),
      missing_names_(streets == MapStreets::all ? std::vector<std::string>()
                                                : models::unfelt_names(*scene.map)) {}

MapPoint MapGuide::pixel_of(Place place) const {
  return {place.x_m / scene_m_per_px_ + 0.5 * map().width_px - 0.5,
          0.5 * map().height_px - place.y_m / scene_m_per_px_ - 0.5};
}

Place MapGuide::place_of(MapPoint pixel) const {
  return {(pixel.x + 0.5 - 0.5 * map().width_px) * scene_m_per_px_,
          (0.5 * map().height_px - pixel.y - 0.5) * scene_m_per_px_};
}

std::string MapGuide::distance_words(double px) const {
  if (!(map().metres_per_px > 0.0)) return spoken_length(metres_on_device(px));
  const double metres = px * map().metres_per_px;
  constexpr double kKilometre = 1000.0;
  if (metres >= kKilometre)
    return phrase("{} kilometres", with_own_point(fmt::format("{:.1f}", metres / kKilometre)));
  const double step = metres < 100.0 ? 5.0 : 10.0;
  return phrase("{:.0f} metres", std::max(step, step * std::round(metres / step)));
}

std::string MapGuide::direction_words(double bearing) const {
  constexpr std::array kCompass{"north", "north-east", "east", "south-east",
                                "south", "south-west", "west", "north-west"};
  constexpr std::array kOnPage{"up",   "up and right",  "right", "down and right",
                               "down", "down and left", "left",  "up and left"};
  const long eighth = std::lround(bearing / (0.25 * std::numbers::pi));
  const auto k = static_cast<std::size_t>((eighth % 8 + 8) % 8);
  return tr(map().metres_per_px > 0.0 ? kCompass[k] : kOnPage[k]);
}

std::string MapGuide::region_of(MapPoint pixel) const {
  return region_words(place_of(pixel), metres_on_device(map().width_px), metres_on_device(map().height_px));
}

bool MapGuide::is_at_edge(MapPoint pixel) const {
  constexpr double kEdge_px = 3.0;
  return pixel.x < kEdge_px || pixel.y < kEdge_px || pixel.x > map().width_px - 1 - kEdge_px ||
         pixel.y > map().height_px - 1 - kEdge_px;
}

std::vector<std::string> MapGuide::names_at(std::size_t node) const {
  std::set<std::string> names;
  for (const std::size_t piece : network_.nodes()[node].pieces)
    if (!map().streets[piece].name.empty()) names.insert(map().streets[piece].name);
  return {names.begin(), names.end()};
}

}  // namespace palpable::describe
