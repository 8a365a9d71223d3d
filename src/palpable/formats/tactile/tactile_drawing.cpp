// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/tactile_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

constexpr double kMm = 1000.0;

/// Six-dot patterns as North American braille ASCII, by dots 1 to 6 as bits 0 to 5.
constexpr std::string_view kBrailleAscii =
    R"( A1B'K2L@CIF/MSP"E3H9O6R^DJG>NTQ,*5<-U8V.%[$+X!&;:4\0Z7(_?W]#Y)=)";
static_assert(kBrailleAscii.size() == 64);

/// The dots of a page, and which of them are raised.
class Page {
 public:
  explicit Page(const BrailleOptions& options)
      : options_(options),
        cells_(static_cast<std::size_t>(options.columns) * static_cast<std::size_t>(options.rows)) {}

  double width_m() const { return (options_.columns - 1) * options_.cell_m + options_.dot_m; }
  double height_m() const { return (options_.rows - 1) * options_.line_m + 2.0 * options_.dot_m; }

  /// Raises the dot nearest to a position on the paper, measured from the first dot.
  void raise(double right_m, double down_m) {
    const auto [column, dot_column] = nearest(right_m, options_.cell_m, 2, options_.columns);
    const auto [row, dot_row] = nearest(down_m, options_.line_m, 3, options_.rows);
    const auto at = static_cast<std::size_t>(row) * static_cast<std::size_t>(options_.columns) +
                    static_cast<std::size_t>(column);
    cells_[at] |= static_cast<std::uint8_t>(1U << static_cast<unsigned>(3 * dot_column + dot_row));
  }

  std::string text() const {
    std::string out;
    for (int row = 0; row < options_.rows; ++row) {
      std::string line;
      for (int column = 0; column < options_.columns; ++column)
        line +=
            kBrailleAscii[cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(options_.columns) +
                                 static_cast<std::size_t>(column)]];
      line.erase(line.find_last_not_of(' ') + 1);
      out += line + "\r\n";
    }
    return out + "\f";
  }

 private:
  /// The cell, and the dot in it, nearest to a position on an axis.
  std::pair<int, int> nearest(double at_m, double pitch_m, int dots, int cells) const {
    std::pair<int, int> best{0, 0};
    double least = 1e9;
    const int near = static_cast<int>(at_m / pitch_m);
    for (int cell = std::max(0, near - 1); cell <= std::min(cells - 1, near + 1); ++cell)
      for (int dot = 0; dot < dots; ++dot)
        if (const double off = std::abs(cell * pitch_m + dot * options_.dot_m - at_m); off < least) {
          least = off;
          best = {cell, dot};
        }
    return best;
  }

  BrailleOptions options_;
  std::vector<std::uint8_t> cells_;
};

bool within(double value, double least, double most) { return value >= least && value <= most; }

/// Calls `visit` for points along the line, at most `step_m` apart.
template <class Visit>
void walk(const Polyline& line, double step_m, const Visit& visit) {
  const std::size_t pieces = line.points.size() - (line.closed ? 0 : 1);
  for (std::size_t i = 0; i < pieces; ++i) {
    const Vec3 from = line.points[i], to = line.points[(i + 1) % line.points.size()];
    const int steps = std::max(1, static_cast<int>(std::ceil(norm(to - from) / step_m)));
    for (int k = 0; k <= steps; ++k) visit(from + (static_cast<double>(k) / steps) * (to - from));
  }
}

}  // namespace

Result<std::string> encode_swell_paper(std::span<const Polyline> lines, double width_m, double height_m,
                                       const SwellPaperOptions& options) {
  if (!within(options.line_width_m, 0.00005, 0.01))
    return Error{ErrorCode::usage, "the lines must be 0.05 to 10 mm wide", {}};
  if (options.width_m != 0.0 && !within(options.width_m, 0.01, 1.0))
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
  if (options.columns < 10 || options.columns > 100 || options.rows < 5 || options.rows > 100)
    return Error{ErrorCode::usage, "a braille page must have 10 to 100 columns and 5 to 100 rows", {}};
  for (const double distance : {options.dot_m, options.cell_m, options.line_m})
    if (!within(distance, 0.001, 0.02))
      return Error{ErrorCode::usage, "the distances of braille dots must be 1 to 20 mm", {}};
  Page page(options);
  const double scale = std::min(page.width_m() / width_m, page.height_m() / height_m);
  const double left_m = 0.5 * (page.width_m() - scale * width_m),
               top_m = 0.5 * (page.height_m() - scale * height_m);
  for (const Polyline& line : lines)
    if (line.points.size() > 1)
      walk(line, 0.25 * options.dot_m / scale, [&](Vec3 p) {
        page.raise(left_m + scale * (p.x + 0.5 * width_m), top_m + scale * (0.5 * height_m - p.y));
      });
  return page.text();
}

}  // namespace palpable::formats
