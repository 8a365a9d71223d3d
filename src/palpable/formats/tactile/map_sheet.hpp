// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/result.hpp"
#include "palpable/formats/tactile/braille_cells.hpp"
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::formats {

/// A street of a tactile map.
struct SheetStreet {
  /// Its lines, metres, the longest first.
  std::vector<Polyline> lines;
  /// Written beside it; empty: none.
  BrailleLine key;
};

/// A street map as a tactile drawing: x right, y up, the origin in its middle.
struct MapSheet {
  double width_m = 0.0;
  double height_m = 0.0;
  /// The most important first: they get their keys first.
  std::vector<SheetStreet> streets;
  std::vector<Polyline> waters;
};

struct MapSheetOptions {
  /// Width of the printed drawing, 50 ... 1000 mm.
  double width_m = 0.18;
  /// Width of a street's line, and least distance between lines and braille, 0.5 ... 20 mm.
  double street_m = 0.002;
  double gap_m = 0.003;
  /// Braille dots: diameter, distances of dots in a cell and of cells in a line (Marburg Medium), 0.5 ... 20
  /// mm.
  double dot_diameter_m = 0.0016;
  double dot_m = 0.0025;
  double cell_m = 0.006;
  double line_m = 0.010;
};

/// A drawing, and which streets' keys found no room.
struct SheetDrawing {
  std::string text;
  std::vector<std::size_t> without_room;
};

/// The map as an SVG for swell paper: streets as lines with their keys in braille beside them, water as
/// horizontal strokes. Errors: usage for options out of range.
Result<SheetDrawing> encode_map_sheet(const MapSheet& sheet, const MapSheetOptions& options);

/// Lines of braille as pages of A4 for swell paper, one SVG each.
std::vector<std::string> encode_key_sheets(const std::vector<BrailleLine>& lines,
                                           const MapSheetOptions& options);

/// Whether a file is such a page, by its first bytes.
bool is_key_sheet(std::string_view svg);

/// The map as one page of braille dots with the keys where they have room, and the lines of its key on the
/// following pages. Errors: as encode_braille().
Result<SheetDrawing> encode_map_braille(const MapSheet& sheet, const std::vector<BrailleLine>& lines,
                                        const BrailleOptions& options);

}  // namespace palpable::formats
