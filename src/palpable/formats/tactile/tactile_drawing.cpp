// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include "palpable/formats/tactile/line_spacing.hpp"
#include "palpable/formats/tactile/walked_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <vector>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

/// A pin, in columns and rows from the upper left.
struct Pin {
  int column = 0, row = 0;
  bool operator==(const Pin&) const = default;
};

bool are_neighbours(Pin a, Pin b) {
  return std::abs(a.column - b.column) <= 1 && std::abs(a.row - b.row) <= 1;
}

/// Whether `b` lies in the middle between its neighbours.
bool is_straight(Pin a, Pin b, Pin c) {
  return a.column + c.column == 2 * b.column && a.row + c.row == 2 * b.row;
}

/// Leaves out the pins at the inside of a stair's steps, which make it thick. Corners between straight lines
/// stay.
std::vector<Pin> without_steps(const std::vector<Pin>& pins) {
  std::vector<Pin> thin;
  for (std::size_t i = 0; i < pins.size(); ++i) {
    const bool is_inner =
        i > 0 && i + 1 < pins.size() && !thin.empty() && are_neighbours(thin.back(), pins[i + 1]);
    const bool is_corner = i > 1 && i + 2 < pins.size() && is_straight(pins[i - 2], pins[i - 1], pins[i]) &&
                           is_straight(pins[i], pins[i + 1], pins[i + 2]);
    if (!is_inner || is_corner) thin.push_back(pins[i]);
  }
  return thin;
}

/// The pins of a line in its order.
std::vector<Pin> pins_of(const Polyline& line, double pitch_m, const PinOptions& options) {
  const auto nearest = [](double at, int pins) {
    return std::clamp(static_cast<int>(std::lround(at)), 0, pins - 1);
  };
  std::vector<Pin> pins;
  walk_along(line, 0.25 * pitch_m, [&](Vec3 p) {
    const Pin pin{nearest(0.5 * (options.columns - 1) + p.x / pitch_m, options.columns),
                  nearest(0.5 * (options.rows - 1) - p.y / pitch_m, options.rows)};
    if (pins.empty() || pins.back() != pin) pins.push_back(pin);
  });
  return without_steps(pins);
}

}  // namespace

BrailleOptions braille_on(Paper paper, double width_m, double height_m) {
  constexpr double kMargin_m = 0.010;
  const PaperSize size = paper_for(paper, width_m, height_m, kMargin_m);
  BrailleOptions options;
  options.columns = whole_steps(size.width_m - 2.0 * kMargin_m, options.cell_m);
  options.rows = whole_steps(size.height_m - 2.0 * kMargin_m, options.line_m);
  return options;
}

double pin_pitch_on(double width_m, double height_m, const PinOptions& options) {
  return std::max(width_m / (options.columns - 1), height_m / (options.rows - 1));
}

Result<std::string> encode_pins(std::span<const Polyline> lines, double width_m, double height_m,
                                const PinOptions& options) {
  const auto [columns, rows, spacing, on_display_m] = options;
  if (columns < 2 || columns > 1000 || rows < 2 || rows > 1000 || !(on_display_m > 0.0))
    return Error{ErrorCode::usage, "a tactile display must have 2 to 1000 pins on each side", {}};
  // The outermost pins are at the drawing's borders.
  const double pitch_m = pin_pitch_on(width_m, height_m, options);
  std::vector<std::string> raised(static_cast<std::size_t>(rows),
                                  std::string(static_cast<std::size_t>(columns), '0'));
  const auto raise = [&](const Polyline& line) {
    for (const Pin pin : pins_of(line, pitch_m, options))
      raised[static_cast<std::size_t>(pin.row)][static_cast<std::size_t>(pin.column)] = '1';
  };
  if (spacing == LineSpacing::spaced) {
    constexpr double kPins = 2.0;
    for (const auto& pieces : spaced_lines(lines, kPins * pitch_m))
      std::for_each(pieces.begin(), pieces.end(), raise);
  } else {
    std::for_each(lines.begin(), lines.end(), raise);
  }
  return fmt::format("P1\n{} {}\n{}\n", columns, rows, fmt::join(raised, "\n"));
}

}  // namespace palpable::formats
