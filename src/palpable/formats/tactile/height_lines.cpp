// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/height_lines.hpp"

#include "palpable/core/picture/level_lines.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

using Line = std::vector<RasterPoint>;

double length_of(const Line& line) {
  double sum = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i)
    sum += std::hypot(line[i].x - line[i - 1].x, line[i].y - line[i - 1].y);
  return sum;
}

/// A height, and the width factor of its lines.
struct Level {
  double height_m;
  double width;
};

std::vector<Level> levels_of(double lowest_m, double highest_m, const HeightLineOptions& options) {
  std::vector<Level> levels;
  if (options.outline_m) {
    levels.push_back({*options.outline_m, 1.5});
    for (int k = 1; k * options.interval_m < highest_m; ++k)
      if (k * options.interval_m > 1.5 * *options.outline_m) levels.push_back({k * options.interval_m, 1.0});
    return levels;
  }
  for (int k = 0; (k + 0.5) * options.interval_m < highest_m - lowest_m; ++k)
    levels.push_back({lowest_m + (k + 0.5) * options.interval_m, k % 5 == 4 ? 1.5 : 1.0});
  return levels;
}

struct Range {
  double lowest_m;
  double highest_m;
};

Range range_of(const Raster<float>& heights_m) {
  const auto [low, high] = std::minmax_element(heights_m.values().begin(), heights_m.values().end());
  return {*low, *high};
}

Result<void> check(const HeightLineOptions& options, const Range& heights) {
  constexpr double kMostLines = 200.0;
  const double range = heights.highest_m - heights.lowest_m;
  if (!(options.interval_m > 0.0) || range / options.interval_m > kMostLines)
    return Error{
        ErrorCode::usage, "the height from line to line must be above 0 and give at most 200 lines", {}};
  if (!(options.line_width_m >= 0.00005 && options.line_width_m <= 0.01))
    return Error{ErrorCode::usage, "the lines must be 0.05 to 10 mm wide", {}};
  if ((options.outline_m && !(*options.outline_m > 0.0)) ||
      !(options.least_length_m >= 0.0 && options.least_length_m <= 0.1))
    return Error{ErrorCode::usage, "an outline must be above 0, and the shortest line 0 to 100 mm", {}};
  return {};
}

}  // namespace

Result<std::vector<Polyline>> height_polylines(const Raster<float>& heights_m, double pixel_m,
                                               const HeightLineOptions& options) {
  const Range range = range_of(heights_m);
  if (const auto checked = check(options, range); !checked) return checked.error();
  std::vector<Polyline> lines;
  for (const Level& level : levels_of(range.lowest_m, range.highest_m, options))
    for (const Line& line : level_lines(heights_m, level.height_m)) {
      if (length_of(line) * pixel_m < options.least_length_m) continue;
      Polyline& added = lines.emplace_back();
      for (const RasterPoint& point : line)
        added.points.push_back({(point.x + 0.5 - 0.5 * heights_m.width()) * pixel_m,
                                (0.5 * heights_m.height() - point.y - 0.5) * pixel_m, 0.0});
    }
  return lines;
}

Result<std::string> encode_height_lines(const Raster<float>& heights_m, double pixel_m,
                                        const HeightLineOptions& options) {
  const Range range = range_of(heights_m);
  if (const auto checked = check(options, range); !checked) return checked.error();
  const double mm = 1000.0;
  const double pixel_mm = mm * pixel_m;
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.3f}mm\" height=\"{1:.3f}mm\" viewBox=\"0 0 "
      "{0:.3f} "
      "{1:.3f}\">\n<title>Lines of equal height, every {2:g} mm</title>\n<rect width=\"100%\" "
      "height=\"100%\" "
      "fill=\"white\"/>\n<g fill=\"none\" stroke=\"black\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\">\n",
      pixel_mm * heights_m.width(), pixel_mm * heights_m.height(), mm * options.interval_m);
  for (const Level& level : levels_of(range.lowest_m, range.highest_m, options)) {
    for (const Line& line : level_lines(heights_m, level.height_m)) {
      if (length_of(line) * pixel_m < options.least_length_m) continue;
      svg += fmt::format("<path stroke-width=\"{:.3f}\" d=\"", mm * level.width * options.line_width_m);
      for (std::size_t i = 0; i < line.size(); ++i)
        svg += fmt::format("{}{:.3f} {:.3f}", i == 0 ? 'M' : 'L', (line[i].x + 0.5) * pixel_mm,
                           (line[i].y + 0.5) * pixel_mm);
      svg += "\"/>\n";
    }
  }
  svg += "</g>\n</svg>\n";
  return svg;
}

}  // namespace palpable::formats
