// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace palpable::sculpt {

/// What a sample of a map's relief belongs to.
enum class MapPart : std::uint8_t { land, street, building, water };

/// What a finger can tell apart on a map (methods.md 8: ISO 19028, BANA). Lengths 0.1 ... 20 mm.
struct TactileRules {
  /// Least difference of height between the land and a street, a building or water.
  double least_relief_m = 0.0008;
  /// Least distance between two buildings, between two waters, from water to a street, and of the land
  /// between two grooves.
  double least_gap_m = 0.003;
  /// Least width of a groove.
  double least_groove_m = 0.003;
  /// Least width of a building or water.
  double least_part_m = 0.003;
  /// A groove at least this wide is a hollow in which no street is felt: more than the crossing of two widest
  /// grooves of 6 mm with its rounded corners, 9.7 mm.
  double hollow_m = 0.01;
  /// The part of the plate, 0 ... 1, above which hollows are worth a warning.
  double most_hollow = 0.02;
  /// Differences of height are checked with this tolerance, metres: the surface is a spline through its
  /// control values, and land has its own rounding. 0 ... 1 mm.
  double height_tolerance_m = 1e-5;
  /// Widths are checked with this tolerance, samples of the relief. 0 ... 10.
  double width_tolerance = 1.5;
};

/// A place where a relief breaks a rule.
struct TactileViolation {
  enum class Rule : std::uint8_t { low_relief, narrow_gap, narrow_groove, small_part };
  Rule rule = Rule::low_relief;
  MapPart part = MapPart::land;
  /// The place, scene frame.
  double x_m = 0.0;
  double y_m = 0.0;
  /// What was measured there instead: a difference of height or a width, metres. For small parts and narrow
  /// grooves the widest circle in them.
  double measured_m = 0.0;
};
std::string_view words_of(TactileViolation::Rule rule);

/// Checks a finished relief; `parts` has one value for each of its samples. Corners (of land between streets
/// that meet, of buildings) are rounded by the hand anyway: a narrow place is reported if it is larger than a
/// corner of a right angle. An independent measure: it does not know how the relief was made.
std::vector<TactileViolation> check_tactile_rules(const models::Relief& relief, const Raster<MapPart>& parts,
                                                  const TactileRules& rules);

/// The part of a plate, 0 ... 1, that circles of the diameter `rules.hollow_m` inside of its grooves cover:
/// where streets ran together. `sample_m`: distance of samples, metres.
double hollow_part(const Raster<MapPart>& parts, double sample_m, const TactileRules& rules);

}  // namespace palpable::sculpt
