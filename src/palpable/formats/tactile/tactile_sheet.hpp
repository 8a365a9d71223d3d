// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/geometry/polyline.hpp"
#include "palpable/core/result.hpp"
#include "palpable/formats/tactile/braille_cells.hpp"
#include "palpable/formats/tactile/paper.hpp"
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace palpable::formats {

/// Lines of a drawing that belong together, as those of a street, metres; of several the longest first.
struct SheetStroke {
  std::vector<Polyline> lines;
  /// Written beside them; empty: none.
  BrailleLine key = {};
  /// Of the width of their lines.
  double weight = 1.0;
};

/// A point, line or region with a name.
struct SheetPlace {
  BrailleLine key;
  Vec3 at;
  /// Whether a place is in the region; its key stands in it, if there is room. Empty: a point or a line.
  std::function<bool(Vec3)> contains = {};
  enum class Mark : std::uint8_t { none, disc };
  Mark mark = Mark::none;
};

/// A tactile drawing: metres, x right, y up, the origin in its middle.
struct TactileSheet {
  std::string title;
  double width_m = 0.0;
  double height_m = 0.0;
  /// The most important first: they are drawn, and get their keys, first.
  std::vector<SheetStroke> strokes;
  std::vector<Polyline> waters = {};
  /// In the order in which their keys find room.
  std::vector<SheetPlace> places = {};
};

struct SheetOptions {
  /// The drawing is as large as this paper allows, with a margin of 15 mm without ink; else `width_m` wide.
  std::optional<Paper> paper;
  /// Width of the printed drawing, 10 ... 1000 mm.
  double width_m = 0.18;
  /// Width of a line, and least distance between lines and braille, 0.5 ... 20 mm.
  double line_m = 0.002;
  double gap_m = 0.003;
  /// Whether the lines keep four fifths of the gap from each other (line_spacing.hpp), or are far enough
  /// apart already.
  LineSpacing spacing = LineSpacing::as_they_are;
  /// Braille dots: diameter, distances of dots in a cell and of cells in a line (Marburg Medium), 0.5 ... 20
  /// mm.
  double dot_diameter_m = 0.0016;
  double dot_m = 0.0025;
  double cell_m = 0.006;
  double row_m = 0.010;
};

/// How wide a drawing of these proportions is on paper.
double printed_width_m(double width, double height, const SheetOptions& options);

/// How far from its place a key may stand on a drawing with this diagonal: 25 mm on A4, more on larger ones.
double key_reach_m(double diagonal_m);

/// A drawing, and which keys found no room. They are counted from 0: first those of strokes, then those of
/// places.
struct SheetDrawing {
  std::string text;
  std::vector<std::size_t> without_room = {};
};

/// The drawing as an SVG for swell paper: lines with their keys in braille beside them, water as horizontal
/// strokes, marks as discs of 4 mm. Errors: usage for options out of range.
Result<SheetDrawing> encode_sheet(const TactileSheet& sheet, const SheetOptions& options);

/// Lines of braille as pages of A4 for swell paper, one SVG each.
std::vector<std::string> encode_key_sheets(const std::vector<BrailleLine>& lines,
                                           const SheetOptions& options);

/// Whether a file is such a page, by its first bytes.
bool is_key_sheet(std::string_view svg);

/// The drawing as one page of braille dots with the keys where they have room, and the lines of its key on
/// the following pages. Errors: as check_braille().
Result<SheetDrawing> encode_braille_sheet(const TactileSheet& sheet, const std::vector<BrailleLine>& lines,
                                          const BrailleOptions& options);

/// The lines of a drawing, the most important first.
std::vector<Polyline> lines_of(const TactileSheet& sheet);

}  // namespace palpable::formats
