// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/streets/lines/carriageways.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <cstdint>
#include <vector>

namespace palpable::vision {

struct HiddenSideOptions {
  /// A street's direction at a point is that of so many points on both sides. 1 ... 50.
  int direction_points = 6;
  /// Its border is looked for up to this many of its radii away, 1 ... 10, in such steps, pixels, 0.1 ... 5.
  double reach_radii = 2.5;
  double step_px = 0.5;
  /// The border is that of another street if one begins within this distance behind it, pixels. 0 ... 20.
  double casing_px = 3.0;
  /// A street's radius is the median over its points whose two borders can be seen, if there are so many of
  /// them. 1 ... 1000.
  int fewest_points = 8;
  /// One side is hidden where less than this part of the street's width can be seen. 0 ... 1.
  double most_visible = 0.9;
  /// Widths are measured, and lines moved, where the line is at most this far from the middle of what can be
  /// seen, pixels. 0 ... 50.
  double most_aside_px = 2.0;
  /// The shift is the median over this many points on both sides. 0 ... 100.
  int median_points = 5;
};
std::vector<Parameter> parameters_of(HiddenSideOptions& options);

/// Where a street of another colour covers one side of a street, the line in the middle of what can be seen
/// is beside the street's own middle: it is moved to the street's radius from the border of the other side. A
/// line of which no piece can be seen whole has the next wider common radius (`widths`) of its colour.
/// `mask`: streets of one colour, `others`: those of other colours. Any thread.
void centre_hidden_sides(CentreLines& graph, const Raster<std::uint8_t>& mask,
                         const Raster<std::uint8_t>& others, const HiddenSideOptions& options = {},
                         const CarriagewayOptions& widths = {});

}  // namespace palpable::vision
