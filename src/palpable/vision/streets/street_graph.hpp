// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/map_colours.hpp"
#include "palpable/vision/streets/street_colours.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

namespace palpable::vision {

struct StreetGraphOptions {
  /// A street whose end faces another street continues to that street's centre line over a border of at most
  /// this width, pixels.
  double border_px = 6.0;
  /// A street goes on along lettering whose direction differs by at most this much, degrees, and that begins
  /// at most this many of its heights behind the street's end.
  double name_angle_deg = 35.0;
  double name_margin = 1.5;
  /// Longest gap (left by a name or a symbol) between two ends that face each other, pixels.
  double gap_px = 140.0;
  /// Longest part of it that may lie on other streets, pixels.
  double crossing_px = 40.0;
  /// Largest angle between a street's end and the gap that it continues over, degrees.
  double gap_angle_deg = 25.0;
  /// At least this part of a gap must be covered by lettering, symbols or other streets.
  double gap_covered = 0.7;
  /// Connected streets shorter than this in total are removed, as a part of the picture's shorter side.
  double least_network_part = 0.04;
};

/// Joins the centre lines of all colours of streets: a street ends in the middle of the street that it meets,
/// a street that ends at its name goes on along it (`names`: all lettering), gaps left by names are closed,
/// double junctions are one, and small fragments are removed. Any thread.
CentreLines join_streets(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                         const std::vector<TextLine>& names, const StreetGraphOptions& options = {});

}  // namespace palpable::vision
