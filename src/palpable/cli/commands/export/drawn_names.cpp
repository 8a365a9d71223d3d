// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/cli/commands/export/drawn_names.hpp"

#include "palpable/describe/name_keys.hpp"
#include "palpable/describe/place_guide.hpp"
#include "palpable/describe/scene_words.hpp"

#include <cstddef>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace palpable::cli {
namespace {

using Extent = models::PlaceName::Extent;

bool is_drawn(const models::Scene& scene, const describe::NamedPlace& place) {
  if (place.written) return true;
  if (place.name.extent != Extent::label ||
      std::holds_alternative<std::shared_ptr<const models::Contours>>(scene.model))
    return false;
  const std::size_t label = models::label_at(scene, {{place.name.at.x_m, place.name.at.y_m, 0.0}});
  return scene.materials[label].name != models::Material{}.name;
}

/// Which places a name covers; empty for a point or a line.
std::function<bool(Vec3)> cover_of(const models::Scene& scene, const models::PlaceName& name) {
  if (name.extent == Extent::label) {
    const std::size_t label = models::label_at(scene, {{name.at.x_m, name.at.y_m, 0.0}});
    return [&scene, label](Vec3 p) { return models::label_at(scene, {{p.x, p.y, 0.0}}) == label; };
  }
  if (name.extent == Extent::area)
    return [line = name.line](Vec3 p) { return models::nearest_in_area(line, {p.x, p.y}).distance_m == 0.0; };
  return {};
}

formats::SheetPlace place_of(const models::Scene& scene, const models::PlaceName& name,
                             const std::string& key) {
  formats::SheetPlace place{formats::plain_braille(key), {name.at.x_m, name.at.y_m, 0.0}};
  place.contains = cover_of(scene, name);
  if (name.extent == Extent::point) place.mark = formats::SheetPlace::Mark::disc;
  // An outline's own place is its beginning.
  if (name.extent == Extent::area) {
    place.at = {};
    for (const Place p : name.line)
      place.at += 1.0 / static_cast<double>(name.line.size()) * Vec3{p.x_m, p.y_m, 0.0};
  }
  return place;
}

/// Of the places of a scene that are drawn; `taken` keys are left out.
void add_places(const models::Scene& scene, bool (*is_one)(const models::Scene&, const describe::NamedPlace&),
                const std::set<std::string>& taken, KeyedDrawing& drawing) {
  const describe::PlaceGuide guide(scene);
  std::vector<const models::PlaceName*> drawn;
  std::vector<std::string> names;
  for (const describe::NamedPlace& place : guide.places())
    if (is_one(scene, place)) {
      drawn.push_back(&place.name);
      names.push_back(place.name.name);
    }
  auto keys = describe::name_keys(names);
  for (std::size_t k = 0; k < drawn.size(); ++k) {
    if (keys[k].empty()) {
      ++drawing.not_drawn;
      continue;
    }
    while (taken.contains(keys[k])) keys[k] += 'x';
    drawing.sheet.places.push_back(place_of(scene, *drawn[k], keys[k]));
    drawing.key_lines.push_back(keys[k] + " " + shortened(names[k]));
  }
}

}  // namespace

void add_names(const models::Scene& scene, KeyedDrawing& drawing) {
  const std::size_t before = drawing.key_lines.size() + drawing.not_drawn;
  add_places(scene, is_drawn, {}, drawing);
  if (drawing.key_lines.size() + drawing.not_drawn > before)
    drawing.heading.push_back(shortened(describe::name_of(scene)));
}

void add_written_names(const models::Scene& scene, KeyedDrawing& drawing) {
  std::set<std::string> taken;
  for (const std::string& line : drawing.key_lines) taken.insert(line.substr(0, line.find(' ')));
  const std::size_t before = drawing.key_lines.size();
  add_places(
      scene,
      [](const models::Scene&, const describe::NamedPlace& place) { return place.written.has_value(); },
      taken, drawing);
  if (drawing.key_lines.size() > before) drawing.named += " and names";
}

}  // namespace palpable::cli
