// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/map_places.hpp"

#include "palpable/core/geometry/map_place.hpp"
#include "palpable/describe/language.hpp"
#include "palpable/describe/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace palpable::describe {
namespace {

/// A probe is at a place within this distance of it on the device.
constexpr double kAtPlace_m = 0.0015;

MapPoint middle_of(const MapLabel& label) {
  const MapPoint a = label.box.front(), b = label.box[label.box.size() / 2];
  return {0.5 * (a.x + b.x), 0.5 * (a.y + b.y)};
}

/// Whether a point is inside of a ring (crossings of a ray).
bool is_inside_ring(MapPoint p, const std::vector<MapPoint>& ring) {
  bool inside = false;
  for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++)
    if ((ring[i].y > p.y) != (ring[j].y > p.y) &&
        p.x < (ring[j].x - ring[i].x) * (p.y - ring[i].y) / (ring[j].y - ring[i].y) + ring[i].x)
      inside = !inside;
  return inside;
}

bool is_large(MapPlace::Kind kind) { return is_special_building(kind) || kind == MapPlace::Kind::roundabout; }

std::string where_words(const MapGuide& guide, const NamedPlace& place) {
  return fmt::format("{}, {}{}", place.words, guide.region_of(guide.pixel_of(place.name.at)),
                     place.felt ? "" : tr(", which cannot be felt"));
}

}  // namespace

std::string place_words(const MapPlace& place) {
  std::string words = known(std::string(words_of(place.kind)));
  if (place.tactile_paving) words = phrase("{} with tactile paving", words);
  if (place.name.empty()) return words;
  return map_place_kind_in(place.name) == place.kind ? place.name : place.name + ", " + words;
}

std::vector<NamedPlace> named_places(const MapGuide& guide) {
  const StreetMap& map = guide.map();
  std::vector<NamedPlace> places;
  for (const MapPlace& place : map.places) {
    NamedPlace named;
    named.name.name = place.name.empty() ? known(std::string(words_of(place.kind))) : place.name;
    named.name.at = guide.place_of(place.at);
    if (is_special_building(place.kind) && place.outline.size() > 2) {
      named.name.extent = models::PlaceName::Extent::area;
      for (const MapPoint p : place.outline) named.name.line.push_back(guide.place_of(p));
    }
    named.words = place_words(place);
    named.kind = place.kind;
    named.felt = place.felt;
    places.push_back(std::move(named));
  }
  const auto is_place = [&map](const std::string& text) {
    return std::any_of(map.places.begin(), map.places.end(),
                       [&text](const MapPlace& place) { return place.name == text; });
  };
  for (const MapLabel& label : map.labels)
    if (!label.names_street && !label.box.empty() && !is_place(label.text))
      places.push_back({{label.text, {}, guide.place_of(middle_of(label)), {}, {}}, label.text});
  for (std::size_t i = 0; i < guide.written().size(); ++i)
    places.push_back({guide.written()[i], guide.written()[i].name, {}, true, i});
  return places;
}

const MapPlace* place_at(const MapGuide& guide, MapPoint at) {
  const MapPlace* found = nullptr;
  double least = guide.pixels_of(kAtPlace_m);
  for (const MapPlace& place : guide.map().places) {
    const bool is_around =
        is_special_building(place.kind) && place.outline.size() > 2 && is_inside_ring(at, place.outline);
    const double distance = is_around ? 0.0 : std::hypot(place.at.x - at.x, place.at.y - at.y);
    if (distance >= least) continue;
    least = distance;
    found = &place;
  }
  return found;
}

std::string special_places_words(const MapGuide& guide, std::size_t most) {
  std::vector<std::string> words;
  std::size_t more = 0;
  for (const NamedPlace& place : named_places(guide)) {
    if (!place.kind || !is_large(*place.kind)) continue;
    if (words.size() < most)
      words.push_back(where_words(guide, place));
    else
      ++more;
  }
  if (words.empty()) return {};
  if (more > 0) words.push_back(phrase("{} more", more));
  return phrase("Special places: {}.", fmt::join(words, "; "));
}

std::string special_places_text(const MapGuide& guide) {
  std::string lines, counts;
  std::size_t crossings = 0, tactile = 0, entrances = 0;
  for (const MapPlace& place : guide.map().places) {
    crossings += place.kind == MapPlace::Kind::crossing ? 1 : 0;
    tactile += place.tactile_paving ? 1 : 0;
    entrances += place.kind == MapPlace::Kind::entrance ? 1 : 0;
  }
  for (const NamedPlace& place : named_places(guide))
    if (place.kind && *place.kind != MapPlace::Kind::crossing && *place.kind != MapPlace::Kind::entrance)
      lines += capitalised(where_words(guide, place)) + ".\n";
  if (crossings > 0)
    counts += phrase("{}, {} of them with tactile paving.",
                     capitalised(counted(crossings, "crossing", "crossings")), tactile) +
              "\n";
  if (entrances > 0) counts += capitalised(counted(entrances, "entrance", "entrances")) + ".\n";
  if (lines.empty() && counts.empty()) return {};
  return "\nSpecial places.\n" + lines + counts;
}

}  // namespace palpable::describe
