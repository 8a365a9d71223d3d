// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/streets/colours/map_colours.hpp"
#include "palpable/vision/streets/lines/street_colours.hpp"
#include "palpable/vision/text/text_lines.hpp"

#include <vector>

namespace palpable::vision {

struct StreetGraphOptions {
  /// The direction of a street at its end is that of a piece of it that begins one radius from the end and is
  /// this many radii, and this, pixels, long. 0 ... 50 and 1 ... 50.
  double end_radii = 4.0;
  int end_px = 4;
  /// A street whose end faces another street continues to that street's centre line over a border of at most
  /// this width, pixels. 0 ... 50.
  double border_px = 6.0;
  /// It does if that line is at most this many of both radii, and the border, away, 0 ... 5; if its direction
  /// differs by at most this much, degrees, 0 ... 90; and if it is nearer than this part of the picture's
  /// shorter side, 0 ... 0.5.
  double meeting_radii = 1.3;
  double meeting_angle_deg = 60.0;
  double meeting_part = 0.06;
  /// A street goes on along lettering whose direction differs by at most this much, degrees, 0 ... 90, and
  /// that begins at most this many of its heights behind the street's end, 0 ... 10.
  double name_angle_deg = 35.0;
  double name_margin = 1.5;
  /// The street's end is at most this many of the lettering's heights, and a pixel, beside its middle. 0
  /// ... 5.
  double name_aside = 0.6;
  /// Only lettering that is longer than this many of its heights is that of a street. 0 ... 50.
  double name_length = 2.0;
  /// Longest gap (left by a name or a symbol) between two ends that face each other, pixels. 0 ... 1000.
  double gap_px = 140.0;
  /// Longest part of it that may lie on other streets, pixels. 0 ... 1000.
  double crossing_px = 40.0;
  /// Largest angle between a street's end and the gap that it continues over, degrees. 0 ... 90.
  double gap_angle_deg = 25.0;
  /// At least this part of a gap must be covered by lettering, symbols or other streets. 0 ... 1.
  double gap_covered = 0.7;
  /// The wider one of the streets on both sides of a gap is at most this many times as wide. 1 ... 10.
  double gap_width_ratio = 2.5;
  /// A street that ends nearer to the picture's border than this many radii, and this, pixels, goes on to it.
  /// 0
  /// ... 10 and 0 ... 50.
  double reach_radii = 1.5;
  double reach_px = 3.0;
  /// Two junctions nearer than this many radii, and this, pixels, are one. 0 ... 10 and 0 ... 50.
  double merge_radii = 1.2;
  double merge_px = 3.0;
  /// Loops that are shorter than this many radii are none. 0 ... 50.
  double loop_radii = 8.0;
  /// Branches of the finished network that are shorter than this many radii, and this, pixels, are none. 0
  /// ... 10 and 0 ... 50.
  double spur_radii = 1.0;
  double spur_px = 2.0;
  /// Connected streets shorter than this in total are removed, as a part of the picture's shorter side, 0 ...
  /// 1, or than this many radii, 0 ... 100.
  double least_network_part = 0.04;
  double least_network_radii = 6.0;
  /// Before gaps are closed, they are removed if they are shorter than this part of that. 0 ... 1.
  double fragment_part = 0.25;
};
std::vector<Parameter> parameters_of(StreetGraphOptions& options);

/// Joins the centre lines of all colours of streets: a street ends in the middle of the street that it meets,
/// a street that ends at its name goes on along it (`names`: all lettering), gaps left by names are closed,
/// double junctions are one, and small fragments are removed. Any thread.
CentreLines join_streets(const MapColours& colours, const std::vector<LayerOfColour>& layers,
                         const std::vector<TextLine>& names, const StreetGraphOptions& options = {});

/// Joins paths to each other and to the streets of a network, as join_streets() does. Paths that hang
/// together with no street and do not leave the picture are left out. Any thread.
CentreLines join_paths(CentreLines streets, const CentreLines& paths, const MapColours& colours,
                       const std::vector<LayerOfColour>& layers, const std::vector<TextLine>& names,
                       const StreetGraphOptions& options = {});

}  // namespace palpable::vision
