// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/models/material/material.hpp"
#include "palpable/models/relief/relief.hpp"
#include "palpable/sculpt/streets/map_materials.hpp"
#include "palpable/sculpt/streets/special_place_options.hpp"
#include "palpable/sculpt/streets/street_selection.hpp"
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// Where grooves are so near to each other that they are one.
struct MergedGrooveOptions {
  /// Passages between two pieces of land are wide enough if they lack at most this, samples. 0.5 ... 10.
  double tolerance = 1.0;
  /// Depth between merged grooves as a part of that of a street, 0 ... 1, but at least the rules' least
  /// relief: the grooves themselves go on in it as deeper lines. 1: a hollow without lines.
  double floor = 0.5;
  /// The depth of a merged groove follows the distance from its border, smoothed by a Gaussian of this size,
  /// samples, 0.5 ... 20, and replaces that of the single grooves over this difference, samples, 0.1 ... 50.
  double smoothing = 2.0;
  double fade = 4.0;
};
std::vector<Parameter> parameters_of(MergedGrooveOptions& options);

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
  SpecialPlaceOptions places;
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
  /// "street" or the street's name, "steps", "sidewalk", "junction" or "junction of A and B", "building",
  /// "water", or a place's words ("Mill Lane, bus stop"); the first is that of the land.
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
  /// For each place of the map whether it is felt.
  std::vector<bool> felt_places;
};

/// Streets become grooves with rounded walls, buildings are raised, water is lower and rippled, junctions
/// have bumps. Special buildings are higher and rough, roundabouts and other places have a texture of their
/// own. What a finger cannot tell apart is joined or left out (street_selection.hpp, map_areas.hpp),
/// so that check_tactile_rules() finds nothing. Each named street has a material of its own name, as far as
/// there are materials: the longest streets first, then places, then junctions. Errors: as check();
/// invalid_input for a map without streets or size.
Result<StreetRelief> relief_from_street_map(const StreetMap& map, const StreetReliefOptions& options);

}  // namespace palpable::sculpt
