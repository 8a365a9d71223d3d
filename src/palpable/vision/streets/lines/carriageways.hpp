// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <span>
#include <vector>

namespace palpable::vision {

struct CarriagewayOptions {
  /// Widths are measured on lines that are longer than this many of them, and whose width has a smaller
  /// standard deviation than this part of it. 0 ... 20 and 0 ... 1.
  double measured_widths = 1.0;
  double measured_spread = 0.25;
  /// Widths of streets of one colour that differ by less than this part are the same. 0 ... 1.
  double same_width = 0.1;
  /// A width is common if this part of a colour's length has it, 0 ... 1, or a length of this many of it, 0
  /// ... 1000.
  double common_part = 0.1;
  double common_widths = 20.0;
  /// The next wider common width is still that of one carriageway if it is at most this many times as wide. 1
  /// ... 5.
  double next_width = 1.55;
  /// A colour whose streets are this many times as wide as the widest single carriageway of the other colours
  /// shows only streets with two. 1 ... 10.
  double width_ratio = 1.7;
  /// Two carriageways whose middles are nearer to each other than this are one street, pixels. 0 ... 50.
  double least_apart_px = 4.0;
  /// Where a street is more than this many times as wide as a carriageway, it is a square, 1 ... 10, and so
  /// is what is nearer to that than this many of a carriageway's radius, 0 ... 10.
  double most_widths = 2.5;
  double square_margin = 1.5;
  /// Two carriageways run beside each other for at least this many of their widths. 0 ... 20.
  double least_length_widths = 1.2;
  /// Their middles follow the border of the streets: over this many of a carriageway's radius to both sides,
  /// 0.1 ... 5, the nearest places of the border are at least this part as far from each other, 0 ... 1.
  double side_window = 0.5;
  double least_side_ratio = 0.5;
  /// All of them do so for at least this many of a carriageway's widths: where two streets cross, only
  /// corners are near. 0 ... 20.
  double least_side_widths = 1.2;
  /// Behind a corner of the border, as where a street joins, a side goes on if it does not turn by more than
  /// this, degrees. 0 ... 90.
  double side_angle_deg = 35.0;
};
std::vector<Parameter> parameters_of(CarriagewayOptions& options);

/// Half the width of a street, and how long the street is, pixels.
struct MeasuredRadius {
  double radius = 0.0;
  double length = 0.0;
};

/// The common radii of streets of one colour, that of the longest ones first. Any thread.
std::vector<double> common_radii(std::vector<MeasuredRadius> radii, const CarriagewayOptions& options = {});

/// Radius of a single carriageway in each colour of streets: its widest common one, unless that is so wide
/// that it shows two. 0 for a colour without lines. Any thread.
std::vector<double> carriageway_radii(std::span<const CentreLines* const> colours,
                                      const CarriagewayOptions& options = {});

/// Where a mask of streets is wider than one carriageway, two run beside each other. Their centre lines are
/// the places at a carriageway's radius from the mask's border. `radii_px`: that of each of the mask's lines.
/// Any thread.
ThinningGuide carriageways_in(const Raster<std::uint8_t>& mask, const CentreLines& lines,
                              std::span<const double> radii_px, const CarriagewayOptions& options = {});

/// The same with one radius everywhere. Any thread.
ThinningGuide carriageways_in(const Raster<std::uint8_t>& mask, double radius_px,
                              const CarriagewayOptions& options = {});

}  // namespace palpable::vision
