// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/parameters.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/vision/streets/lines/carriageways.hpp"
#include "palpable/vision/streets/lines/casings.hpp"
#include "palpable/vision/streets/lines/centre_lines.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace palpable::vision {

struct EvenRibbonOptions {
  /// A ribbon is longer than this many of its widths, 0 ... 100; its width has a smaller standard deviation
  /// than this part of it, 0 ... 2; and this part of both of its sides has casings, 0 ... 1.
  double least_length_widths = 2.0;
  double most_width_spread = 0.15;
  double least_side_part = 0.5;
  /// A colour shows streets if this part of its ribbons' length has one radius, 0 ... 1, which differs from a
  /// common one of the map's streets by at most this part, 0 ... 1.
  double least_even_part = 0.6;
  double same_radius = 0.15;
  /// A strip with another street beside it, this far behind its border at most, pixels, 0 ... 20, is none
  /// from this part of its length on, 0 ... 1.
  double beside_px = 3.0;
  double most_beside_part = 0.3;
};
std::vector<Parameter> parameters_of(EvenRibbonOptions& options);

/// The streets of a colour that mostly shows areas, as that of squares and pedestrian streets: its ribbons,
/// if they are as wide as each other and as the map's streets. `lines`: all lines of the colour, `streets`:
/// the streets of other colours, `street_radii_px`: their common radii. Any thread.
CentreLines even_ribbons(const Raster<Rgb8>& picture, const CentreLines& lines,
                         const Raster<std::uint8_t>& streets, std::span<const double> street_radii_px,
                         const EvenRibbonOptions& options, const CasingOptions& casings);

}  // namespace palpable::vision
