// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/streets/map_materials.hpp"

#include "palpable/core/geometry/map_place.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>

namespace palpable::sculpt {
namespace {

constexpr std::size_t kMostMaterials = 256;

double street_length_px(const MapStreet& street) {
  double sum = 0.0;
  for (std::size_t i = 1; i < street.points.size(); ++i)
    sum +=
        std::hypot(street.points[i].x - street.points[i - 1].x, street.points[i].y - street.points[i - 1].y);
  return sum;
}

/// The names of the streets that end at a junction, in alphabetical order.
std::set<std::string> names_at(const StreetMap& map, const MapJunction& junction, double reach_px) {
  std::set<std::string> names;
  for (const MapStreet& street : map.streets)
    for (const MapPoint end : {street.points.front(), street.points.back()})
      if (!street.name.empty() && std::hypot(end.x - junction.at.x, end.y - junction.at.y) <= reach_px)
        names.insert(street.name);
  return names;
}

std::string junction_words(const std::set<std::string>& names) {
  if (names.size() < 2) return "junction";
  std::string words = "junction of ";
  std::size_t k = 0;
  for (const std::string& name : names) {
    if (k > 0) words += k + 1 == names.size() ? " and " : ", ";
    words += name;
    ++k;
  }
  return words;
}

models::TouchTexture place_texture(const MapPlace& place, const MapMaterialOptions& o) {
  using Kind = models::TouchTexture::Kind;
  constexpr double kSlanted = 0.25 * std::numbers::pi;
  if (is_special_building(place.kind))
    return {Kind::bumps, o.special_distance_m, o.special_height_m, kSlanted};
  if (place.kind == MapPlace::Kind::roundabout)
    return {Kind::ridges, o.roundabout_distance_m, o.place_height_m, kSlanted};
  if (place.kind == MapPlace::Kind::crossing)
    return {place.tactile_paving ? Kind::bumps : Kind::ridges, o.place_distance_m, o.place_height_m, 0.0};
  return {Kind::grain, o.place_distance_m, o.place_height_m, 0.0};
}

models::Material place_material(const MapPlace& place, const std::vector<models::Material>& basic,
                                const MapMaterialOptions& o) {
  models::Material material = basic[kStreetMaterial];
  if (is_special_building(place.kind)) {
    material = basic[kBuildingMaterial];
    material.static_friction = o.special_static_friction;
    material.dynamic_friction = o.special_dynamic_friction;
  }
  material.texture = place_texture(place, o);
  return material;
}

/// Those of land, buildings, water, streets and junctions without names.
std::vector<models::Material> materials_of(const MapMaterialOptions& options) {
  models::Material land;
  land.name = "land";
  models::Material building = land;
  building.name = "building";
  building.static_friction = options.building_static_friction;
  building.dynamic_friction = options.building_dynamic_friction;
  models::Material water = land;
  water.name = "water";
  water.texture = {models::TouchTexture::Kind::ridges, options.ridge_distance_m, options.ridge_height_m,
                   options.ridge_direction_rad};
  models::Material street = land;
  street.name = "street";
  street.static_friction = options.street_static_friction;
  street.dynamic_friction = options.street_dynamic_friction;
  models::Material junction = street;
  junction.name = "junction";
  junction.texture = {models::TouchTexture::Kind::bumps, options.bump_distance_m, options.bump_height_m, 0.0};
  return {land, building, water, street, junction};
}

/// The list of materials while it is made: one for each name, as far as there is room.
class MaterialList {
 public:
  explicit MaterialList(std::vector<models::Material> basic) : all_(std::move(basic)) {}

  std::size_t room() const { return kMostMaterials - all_.size(); }
  /// The number of the one of this name; nullopt if there is none and no room.
  std::optional<std::uint8_t> add(models::Material material, const std::string& name) {
    const auto known = index_.find(name);
    if (known != index_.end()) return known->second;
    if (room() == 0) return std::nullopt;
    material.name = name;
    const auto number = static_cast<std::uint8_t>(all_.size());
    all_.push_back(std::move(material));
    return index_[name] = number;
  }
  std::uint8_t find(const std::string& name, std::uint8_t otherwise) const {
    const auto known = index_.find(name);
    return known != index_.end() ? known->second : otherwise;
  }
  std::vector<models::Material> take() { return std::move(all_); }

 private:
  std::vector<models::Material> all_;
  std::map<std::string, std::uint8_t> index_;
};

/// The names of felt streets, the longest first.
std::vector<std::string> names_by_length(const StreetMap& map, const std::vector<bool>& felt) {
  std::map<std::string, double> lengths;
  for (std::size_t i = 0; i < map.streets.size(); ++i)
    if (felt[i] && !map.streets[i].name.empty())
      lengths[map.streets[i].name] += street_length_px(map.streets[i]);
  std::vector<std::pair<double, std::string>> longest;
  for (const auto& [name, length] : lengths) longest.emplace_back(-length, name);
  std::sort(longest.begin(), longest.end());
  std::vector<std::string> names;
  for (auto& [length, name] : longest) names.push_back(std::move(name));
  return names;
}

/// Steps, sidewalks and paths have textures; those without a name have one material.
models::Material street_material(MapStreet::Kind kind, models::Material street, const MapMaterialOptions& o) {
  using Texture = models::TouchTexture::Kind;
  if (kind == MapStreet::Kind::steps)
    street.texture = {Texture::ridges, o.roundabout_distance_m, o.place_height_m, 0.0};
  if (kind == MapStreet::Kind::sidewalk || kind == MapStreet::Kind::path)
    street.texture = {Texture::grain, o.place_distance_m, 0.5 * o.place_height_m, 0.0};
  return street;
}

}  // namespace

std::vector<Parameter> parameters_of(MapMaterialOptions& o) {
  constexpr double kPi = std::numbers::pi;
  return {
      {"street_static_friction", &o.street_static_friction, {0, 2}, "", "of streets"},
      {"street_dynamic_friction", &o.street_dynamic_friction, {0, 2}, "", "of streets"},
      {"building_static_friction", &o.building_static_friction, {0, 2}, "", "of buildings"},
      {"building_dynamic_friction", &o.building_dynamic_friction, {0, 2}, "", "of buildings"},
      {"special_static_friction", &o.special_static_friction, {0, 2}, "", "of special buildings"},
      {"special_dynamic_friction", &o.special_dynamic_friction, {0, 2}, "", "of special buildings"},
      {"ridge_distance_m", &o.ridge_distance_m, {0.0001, 0.02}, "m", "distance of water's ridges"},
      {"ridge_height_m", &o.ridge_height_m, {0, 0.001}, "m", "their height"},
      {"ridge_direction_rad", &o.ridge_direction_rad, {-kPi, kPi}, "rad", "their direction"},
      {"bump_distance_m", &o.bump_distance_m, {0.0001, 0.02}, "m", "distance of a junction's bumps"},
      {"bump_height_m", &o.bump_height_m, {0, 0.001}, "m", "their height"},
      {"special_distance_m",
       &o.special_distance_m,
       {0.0001, 0.02},
       "m",
       "distance of a special building's bumps"},
      {"special_height_m", &o.special_height_m, {0, 0.001}, "m", "their height"},
      {"roundabout_distance_m",
       &o.roundabout_distance_m,
       {0.0001, 0.02},
       "m",
       "distance of ridges of roundabouts and steps"},
      {"place_distance_m", &o.place_distance_m, {0.0001, 0.02}, "m", "size of the texture of other places"},
      {"place_height_m", &o.place_height_m, {0, 0.001}, "m", "its height"}};
}

MapMaterials map_materials(const StreetMap& map, const std::vector<bool>& felt, double junction_reach_px,
                           const MapMaterialOptions& options) {
  MapMaterials out;
  const std::vector<models::Material> basic = materials_of(options);
  const models::Material &street = basic[kStreetMaterial], &junction = basic[kJunctionMaterial];
  MaterialList list(basic);
  std::map<std::string, MapStreet::Kind> kinds;
  for (const MapStreet& s : map.streets) kinds.try_emplace(s.name, s.kind);
  for (const std::string& name : names_by_length(map, felt))
    if (!list.add(street_material(kinds[name], street, options), name)) ++out.left_out_names;
  for (const MapStreet& s : map.streets) {
    std::uint8_t unnamed = kStreetMaterial;
    if (s.kind != MapStreet::Kind::street && s.name.empty())
      unnamed = list.add(street_material(s.kind, street, options), std::string(kind_words(s.kind)))
                    .value_or(kStreetMaterial);
    out.of_street.push_back(s.name.empty() ? unnamed : list.find(s.name, kStreetMaterial));
  }
  for (const MapPlace& place : map.places) {
    const std::uint8_t plain = is_special_building(place.kind) ? kBuildingMaterial : kJunctionMaterial;
    out.of_place.push_back(list.add(place_material(place, basic, options), words_of(place)).value_or(plain));
  }
  for (const MapJunction& j : map.junctions) {
    const std::string words = junction_words(names_at(map, j, junction_reach_px));
    out.of_junction.push_back(words == "junction" ? kJunctionMaterial
                                                  : list.add(junction, words).value_or(kJunctionMaterial));
  }
  out.materials = list.take();
  return out;
}

}  // namespace palpable::sculpt
