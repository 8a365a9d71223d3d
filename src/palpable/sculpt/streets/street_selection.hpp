// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/street_map.hpp"
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

/// Width of a street's groove: as drawn, within the limits.
double groove_width_m(const MapStreet& street, const MapGrid& grid, const GrooveWidths& widths);

/// Chooses streets by their importance: wide ones first, then named ones, then long ones. A piece is left out
/// if for more than half of its length the land beside it, towards a more important one, would be narrower
/// than the rules' gap. Pieces that connect groups of streets which would not hang together otherwise are
/// felt all the same, merged with their neighbours; short groups that nothing connects are left out.
StreetSelection select_streets(const StreetMap& map, const MapGrid& grid, const GrooveWidths& widths,
                               const TactileRules& rules);

}  // namespace palpable::sculpt
