// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/formats/tactile/braille_cells.hpp"
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace palpable::formats {

/// The dots of a page, and which of them are raised. Positions are measured from its first dot.
class BraillePage {
 public:
  /// Errors of the options: check_braille().
  explicit BraillePage(const BrailleOptions& options);

  double width_m() const { return (options_.columns - 1) * options_.cell_m + options_.dot_m; }
  double height_m() const { return (options_.rows - 1) * options_.line_m + 2.0 * options_.dot_m; }

  /// Raises the dot nearest to a position on the paper.
  void raise(double right_m, double down_m);
  /// Whether no dot of a cell is raised; false outside the page.
  bool is_free(int column, int row) const;
  /// Writes cells in a row; the place must be on the page.
  void write(int column, int row, const BrailleLine& cells);
  /// The row and column of the cell nearest to a position.
  int column_of(double right_m) const;
  int row_of(double down_m) const;

  /// Lines of North American braille ASCII that end with CR LF; the page ends with a form feed.
  std::string text() const;

 private:
  std::size_t index_of(int column, int row) const;

  BrailleOptions options_;
  std::vector<BrailleCell> cells_;
};

/// Where a drawing lies on a page: positions on the paper of points with the origin in the drawing's middle.
struct BrailleView {
  double scale = 1.0;
  double middle_right_m = 0.0;
  double middle_down_m = 0.0;
  double right_m(double x) const { return middle_right_m + scale * x; }
  double down_m(double y) const { return middle_down_m - scale * y; }
};

/// Raises the dots nearest to the lines of a drawing, which is as large as the page allows.
BrailleView draw_dots(BraillePage& page, std::span<const Polyline> lines, double width_m, double height_m,
                      const BrailleOptions& options);

/// Errors: usage for options out of range.
Result<void> check_braille(const BrailleOptions& options);

/// Divides lines at blanks so that none is longer than `columns`; what continues a line is indented by two.
std::vector<BrailleLine> wrapped(const std::vector<BrailleLine>& lines, int columns);

/// Pages of braille text, one after another as encode_braille() writes them.
std::string braille_text(const std::vector<BrailleLine>& lines, const BrailleOptions& options);

}  // namespace palpable::formats
