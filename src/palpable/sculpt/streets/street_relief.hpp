// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/material/material.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/sculpt/streets/street_selection.hpp"
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// Where grooves are so near to each other that they are one.
struct MergedGrooveOptions {
  /// Passages between two pieces of land are wide enough if they lack at most this, samples. 0.5 ... 10.
  double tolerance = 1.0;
  /// The depth of a merged groove follows the distance from its border, smoothed by a Gaussian of this size,
  /// samples, 0.5 ... 20, and replaces that of the single grooves over this difference, samples, 0.1 ... 50.
  double smoothing = 2.0;
  double fade = 4.0;
};
std::vector<Parameter> parameters_of(MergedGrooveOptions& options);

/// What the parts of a map feel like. Friction coefficients 0 ... 2, the dynamic one at most the static one.
struct MapMaterialOptions {
  double street_static_friction = 0.15;
  double street_dynamic_friction = 0.1;
  double building_static_friction = 0.5;
  double building_dynamic_friction = 0.4;
  /// Ridges of water: period 0.1 ... 20 mm and height 0 ... 1 mm, metres; direction, radians, -pi ... pi.
  double ridge_distance_m = 0.003;
  double ridge_height_m = 60e-6;
  double ridge_direction_rad = 0.5;
  /// Bumps of a junction: the same, metres.
  double bump_distance_m = 0.0015;
  double bump_height_m = 25e-6;
};
std::vector<Parameter> parameters_of(MapMaterialOptions& options);

/// How a map becomes a relief. Sizes follow the rules for tactile maps (methods.md 8 and 9) and hold at any
/// scale: what the map draws narrower is drawn as wide as a finger needs it.
struct StreetReliefOptions {
  /// Largest size of the map, metres; its proportions are kept.
  double width_m = 0.1;
  double height_m = 0.1;
  /// Width of the narrowest and the widest groove, 0.5 ... 20 mm.
  double narrowest_street_m = 0.003;
  double widest_street_m = 0.006;
  /// Depth of streets below the land, 0.1 ... 10 mm.
  double street_depth_m = 0.0015;
  /// Height of buildings above the land, 0 ... 20 mm.
  double building_m = 0.0012;
  /// Least distance from a building to a groove, and width of its sloping wall, 0.1 ... 10 mm.
  double building_gap_m = 0.0008;
  double building_wall_m = 0.0005;
  /// Depth of water below the land, 0 ... 10 mm.
  double water_depth_m = 0.0008;
  /// Corners of buildings and waters are rounded by circles of this part of the least width of one. 0 ... 1.
  double area_rounding = 0.5;
  /// Diameter of a junction's texture, as a part of the width of the narrowest groove. 0.1 ... 3.
  double junction_part = 1.0;
  /// Streets that end at most this far from a junction meet there, pixels of the map. 0 ... 50.
  double junction_reach_px = 2.0;
  /// What a finger can tell apart; its narrowest groove is `narrowest_street_m`.
  TactileRules rules;
  StreetSelectionOptions selection;
  MergedGrooveOptions merging;
  MapMaterialOptions materials;
  /// Samples along the longer side, 64 ... 4096.
  int samples = 1024;
};
/// Every parameter with its range, except the size of the map and what only check_tactile_rules() needs.
std::vector<Parameter> parameters_of(StreetReliefOptions& options);

/// Errors: usage, for a parameter out of its range, and for a narrowest street that is wider than the widest.
Result<void> check(const StreetReliefOptions& options);

/// A map to touch: its relief, and what is where.
struct StreetRelief {
  models::Relief relief;
  /// Index into `materials` of each sample of the relief.
  Raster<std::uint8_t> labels;
  /// "street" or the street's name, "junction" or "junction of A and B", "building", "water"; the first is
  /// that of the land.
  std::vector<models::Material> materials;
  /// What each sample of the relief belongs to.
  Raster<MapPart> parts;
  /// Names of the shortest streets, for which there are no more materials.
  std::size_t left_out_names = 0;
  /// Which streets are felt.
  StreetSelection streets;
  /// How many areas the map has, as how many parts they are felt, and how many of them are not.
  struct Areas {
    std::size_t drawn = 0;
    std::size_t parts = 0;
    std::size_t left_out = 0;
  };
  Areas buildings;
  Areas waters;
};

/// Streets become grooves with rounded walls, buildings are raised, water is lower and rippled, junctions
/// have bumps. What a finger cannot tell apart is joined or left out (street_selection.hpp, map_areas.hpp),
/// so that check_tactile_rules() finds nothing. Each named street has a material of its own name, as far as
/// there are materials: the longest streets first, then junctions. Errors: as check(); invalid_input for a
/// map without streets or size.
Result<StreetRelief> relief_from_street_map(const StreetMap& map, const StreetReliefOptions& options);

}  // namespace palpable::sculpt
