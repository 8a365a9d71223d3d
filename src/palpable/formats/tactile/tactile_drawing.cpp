// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include "palpable/formats/tactile/braille_page.hpp"
#include "palpable/formats/tactile/walked_line.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

constexpr double kMm = 1000.0;

bool is_within(double value, double least, double most) { return value >= least && value <= most; }

}  // namespace

Result<std::string> encode_swell_paper(std::span<const Polyline> lines, double width_m, double height_m,
                                       const SwellPaperOptions& options) {
  if (!is_within(options.line_width_m, 0.00005, 0.01))
    return Error{ErrorCode::usage, "the lines must be 0.05 to 10 mm wide", {}};
  if (options.width_m != 0.0 && !is_within(options.width_m, 0.01, 1.0))
    return Error{ErrorCode::usage, "the printed width must be 10 to 1000 mm", {}};
  const double scale = options.width_m > 0.0 ? options.width_m / width_m : 1.0;
  const double to_mm = kMm * scale;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"0 0 "
      "{0:.3f} {1:.3f}\">\n<title>Outlines</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
      "<g fill=\"none\" stroke=\"black\" stroke-width=\"{2:.3f}\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\">\n",
      to_mm * width_m, to_mm * height_m, kMm * options.line_width_m);
  for (const Polyline& line : lines) {
    svg += "<path d=\"";
    for (std::size_t i = 0; i < line.points.size(); ++i)
      svg += fmt::format("{}{:.3f} {:.3f}", i == 0 ? 'M' : 'L', to_mm * (line.points[i].x + 0.5 * width_m),
                         to_mm * (0.5 * height_m - line.points[i].y));
    svg += line.closed ? "Z\"/>\n" : "\"/>\n";
  }
  return svg + "</g>\n</svg>\n";
}

Result<std::string> encode_braille(std::span<const Polyline> lines, double width_m, double height_m,
                                   const BrailleOptions& options) {
  if (auto checked = check_braille(options); !checked) return checked.error();
  BraillePage page(options);
  draw_dots(page, lines, width_m, height_m, options);
  return page.text();
}

Result<std::string> encode_pins(std::span<const Polyline> lines, double width_m, double height_m,
                                const PinOptions& options) {
  const auto [columns, rows, pitch_m] = options;
  if (columns < 1 || columns > 1000 || rows < 1 || rows > 1000 || !(pitch_m > 0.0))
    return Error{ErrorCode::usage, "a tactile display must have 1 to 1000 pins on each side", {}};
  // In pins, from the first one. The outermost pins are at the drawing's borders.
  const double scale = std::min((columns - 1) / width_m, (rows - 1) / height_m);
  std::vector<std::string> raised(static_cast<std::size_t>(rows),
                                  std::string(static_cast<std::size_t>(columns), '0'));
  const auto pin = [](double at, int pins) {
    return static_cast<std::size_t>(std::clamp(static_cast<int>(std::lround(at)), 0, pins - 1));
  };
  for (const Polyline& line : lines)
    walk_along(line, 0.25 / scale, [&](Vec3 p) {
      raised[pin(0.5 * (rows - 1) - scale * p.y, rows)][pin(0.5 * (columns - 1) + scale * p.x, columns)] =
          '1';
    });
  return fmt::format("P1\n{} {}\n{}\n", columns, rows, fmt::join(raised, "\n"));
}

}  // namespace palpable::formats
