// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/result.hpp"
#include "palpable/formats/tactile/paper.hpp"

#include <cstdint>
#include <span>
#include <string>

namespace palpable::formats {

/// Whether lines are drawn as they are, or spaced_lines() of them.
enum class LineSpacing : std::uint8_t { as_they_are, spaced };

struct BrailleOptions {
  /// Cells of a page. 10 … 100; 5 … 100.
  int columns = 40;
  int rows = 25;
  /// With `spaced`, lines are two dots apart.
  LineSpacing spacing = LineSpacing::as_they_are;
  /// Distances of dots in a cell, of cells in a line, and of lines (Marburg Medium). 1 … 20 mm each.
  double dot_m = 0.0025;
  double cell_m = 0.006;
  double line_m = 0.010;
};

/// The cells that this paper has within a margin of 10 mm, upright or across for a drawing of these
/// proportions.
BrailleOptions braille_on(Paper paper, double width_m, double height_m);

/// A tactile display: pins in a square grid.
struct PinOptions {
  int columns = 60;
  int rows = 40;
  /// With `spaced`, lines have a free pin between them.
  LineSpacing spacing = LineSpacing::as_they_are;
  /// Distance of two pins, as that of braille dots.
  double pitch_m = 0.0025;
};

/// How far apart two pins are on a drawing of this size, which is as large as the display allows.
double pin_pitch_on(double width_m, double height_m, const PinOptions& options);

/// The lines as pins, as a plain portable bitmap (PBM, "P1"): one pixel for each pin, 1 for a raised one. The
/// drawing is as large as the display allows, with its proportions kept. Errors: usage for options out of
/// range (2 to 1000 pins on each side).
Result<std::string> encode_pins(std::span<const Polyline> lines, double width_m, double height_m,
                                const PinOptions& options);

}  // namespace palpable::formats
