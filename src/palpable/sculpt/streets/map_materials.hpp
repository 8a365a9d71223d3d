// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/models/material/material.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// What the parts of a map feel like. Friction coefficients 0 ... 2, the dynamic one at most the static one.
struct MapMaterialOptions {
  double street_static_friction = 0.15;
  double street_dynamic_friction = 0.1;
  double building_static_friction = 0.5;
  double building_dynamic_friction = 0.4;
  double special_static_friction = 0.7;
  double special_dynamic_friction = 0.55;
  /// Ridges of water: period 0.1 ... 20 mm and height 0 ... 1 mm, metres; direction, radians, -pi ... pi.
  double ridge_distance_m = 0.003;
  double ridge_height_m = 60e-6;
  double ridge_direction_rad = 0.5;
  /// Bumps of a junction: the same, metres.
  double bump_distance_m = 0.0015;
  double bump_height_m = 25e-6;
  /// Bumps of special buildings, and the textures of the places in the streets and of steps (ridges for
  /// roundabouts, steps and plain crossings, bumps for crossings with tactile paving, grain for stops and
  /// entrances): the same, metres.
  double special_distance_m = 0.0025;
  double special_height_m = 50e-6;
  double roundabout_distance_m = 0.002;
  double place_distance_m = 0.001;
  double place_height_m = 40e-6;
};
std::vector<Parameter> parameters_of(MapMaterialOptions& options);

/// Places in the list of a map's materials; the first one is that of the land.
inline constexpr std::uint8_t kBuildingMaterial = 1, kWaterMaterial = 2, kStreetMaterial = 3,
                              kJunctionMaterial = 4;

/// The materials of a map, at most 256: which one each street, junction and place has.
struct MapMaterials {
  std::vector<models::Material> materials;
  std::vector<std::uint8_t> of_street;
  std::vector<std::uint8_t> of_junction;
  std::vector<std::uint8_t> of_place;
  /// Names of streets for which there are no more materials.
  std::size_t left_out_names = 0;
};

/// `felt`: for each street whether it is felt. Streets that end at most `junction_reach_px` from a junction
/// give it its name.
MapMaterials map_materials(const StreetMap& map, const std::vector<bool>& felt, double junction_reach_px,
                           const MapMaterialOptions& options);

}  // namespace palpable::sculpt
