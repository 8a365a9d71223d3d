// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
#include "palpable/core/parameters.hpp"
#include "palpable/sculpt/streets/map_grid.hpp"
#include "palpable/sculpt/streets/tactile_rules.hpp"

#include <cstddef>
#include <string>
#include <vector>

namespace palpable::sculpt {

/// Which pieces of a map's streets become lines that a finger can tell apart.
struct StreetSelection {
  /// For each piece whether it is felt.
  std::vector<bool> felt;
  /// Pieces for which another one of the same street stands: second carriageways.
  std::size_t merged = 0;
  /// Pieces that are left out, and the names of which nothing is felt, the longest first.
  std::size_t left_out = 0;
  std::vector<std::string> left_out_names;
};

/// Widths of grooves, metres.
struct GrooveWidths {
  double narrowest_m = 0.003;
  double widest_m = 0.006;
};

/// How streets are chosen.
struct StreetSelectionOptions {
  /// Streets are ordered by their widths in steps of this, pixels of the map: among streets of about one
  /// width the longer one counts. 0.1 ... 50.
  double width_step_px = 2.0;
  /// Ends of streets that are at most this far apart meet, pixels of the map. 0.1 ... 50.
  double join_px = 2.0;
  /// What is beside a street is looked at in steps of this, metres, but at least of a sample. 0.01 ... 10 mm.
  double step_m = 0.0004;
  /// A piece is left out if another one is too near beside more than this part of it. 0 ... 1.
  double most_crowded = 0.5;
};
std::vector<Parameter> parameters_of(StreetSelectionOptions& options);

/// Width of a street's groove: as drawn, within the limits.
double groove_width_m(const MapStreet& street, const MapGrid& grid, const GrooveWidths& widths);

/// Chooses streets by their importance: wide ones first, then named ones, then long ones. A piece is left out
/// if for more than `most_crowded` of its length the land beside it, towards a more important one, would be
/// narrower than the rules' gap. Pieces that connect groups of streets which would not hang together
/// otherwise are felt all the same, merged with their neighbours; short groups that nothing connects are left
/// out.
StreetSelection select_streets(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths,
                               const TactileRules& rules, const StreetSelectionOptions& options = {});

}  // namespace palpable::sculpt
