// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/result.hpp"

#include <span>
#include <string>

namespace palpable::formats {

struct SwellPaperOptions {
  /// Width of a printed line, 0.05 … 10 mm. Lines of 0.5 to 1.5 mm rise well on swell paper.
  double line_width_m = 0.0012;
  /// Width of the printed drawing; 0 = true size. 0, or 10 … 1000 mm.
  double width_m = 0.0;
};

/// Lines (metres, x right, y up, the origin in the middle) as an SVG of black lines on white, `width_m` x
/// `height_m` at true size. Errors: usage for options out of range.
Result<std::string> encode_swell_paper(std::span<const Polyline> lines, double width_m, double height_m,
                                       const SwellPaperOptions& options);

struct BrailleOptions {
  /// Cells of a page. 10 … 100; 5 … 100.
  int columns = 40;
  int rows = 25;
  /// Distances of dots in a cell, of cells in a line, and of lines (Marburg Medium). 1 … 20 mm each.
  double dot_m = 0.0025;
  double cell_m = 0.006;
  double line_m = 0.010;
};

/// The lines as dots of six-dot braille on one page, in North American braille ASCII (.brf). The drawing is
/// as large as the page allows, with its proportions kept, and each point of a line raises the nearest dot.
/// Text lines end with CR LF, the page with a form feed. Errors: usage for options out of range.
Result<std::string> encode_braille(std::span<const Polyline> lines, double width_m, double height_m,
                                   const BrailleOptions& options);

/// A tactile display: pins in a square grid.
struct PinOptions {
  int columns = 60;
  int rows = 40;
  /// Distance of two pins, as that of braille dots.
  double pitch_m = 0.0025;
};

/// The lines as pins, as a plain portable bitmap (PBM, "P1"): one pixel for each pin, 1 for a raised one. The
/// drawing is as large as the display allows, with its proportions kept. Errors: usage for options out of
/// range (1 to 1000 pins).
Result<std::string> encode_pins(std::span<const Polyline> lines, double width_m, double height_m,
                                const PinOptions& options);

}  // namespace palpable::formats
