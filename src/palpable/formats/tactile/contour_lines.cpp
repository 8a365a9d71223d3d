// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/contour_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace palpable::formats {
namespace {

/// A crossing of a grid edge, in samples, and the edge's number, which both adjacent cells share.
struct Crossing {
  double x;
  double y;
  std::uint64_t edge;
};
using Line = std::vector<Crossing>;

/// Finds the crossings of one level with the grid (marching squares) and joins the segments to lines.
class LevelTracer {
 public:
  LevelTracer(const Raster<float>& heights, double level) : z_(heights), level_(level) {}

  std::vector<Line> lines() {
    for (int y = 0; y + 1 < z_.height(); ++y)
      for (int x = 0; x + 1 < z_.width(); ++x) cross_cell(x, y);
    std::vector<Line> found;
    used_.assign(pieces_.size(), false);
    for (std::size_t k = 0; k < pieces_.size(); ++k)
      if (!used_[k]) found.push_back(follow(k));
    return found;
  }

 private:
  double above(int x, int y) const { return double{z_(x, y)} - level_; }

  /// Side 0 is the cell's upper edge, 1 its right, 2 its lower, 3 its left one.
  Crossing on_side(int x, int y, int side) const {
    const int x0 = x + (side == 1 ? 1 : 0);
    const int y0 = y + (side == 2 ? 1 : 0);
    const bool across = side == 0 || side == 2;
    const int x1 = x0 + (across ? 1 : 0);
    const int y1 = y0 + (across ? 0 : 1);
    const double a = above(x0, y0);
    const double t = a / (a - above(x1, y1));
    const auto number = static_cast<std::uint64_t>(y0) * static_cast<std::uint64_t>(z_.width()) +
                        static_cast<std::uint64_t>(x0);
    return {x0 + t * (x1 - x0), y0 + t * (y1 - y0), 2 * number + (across ? 0U : 1U)};
  }

  void cross_cell(int x, int y) {
    const std::array<bool, 4> high{above(x, y) > 0, above(x + 1, y) > 0, above(x + 1, y + 1) > 0,
                                   above(x, y + 1) > 0};
    std::vector<int> sides;
    for (int side = 0; side < 4; ++side)
      if (high[static_cast<std::size_t>(side)] != high[static_cast<std::size_t>((side + 1) % 4)])
        sides.push_back(side);
    if (sides.size() == 2) add(x, y, sides[0], sides[1]);
    if (sides.size() != 4) return;
    // A saddle: the mean height decides which corners are connected.
    const bool middle = above(x, y) + above(x + 1, y) + above(x + 1, y + 1) + above(x, y + 1) > 0;
    const int turn = middle == high[0] ? 0 : 3;
    add(x, y, turn, (turn + 1) % 4);
    add(x, y, (turn + 2) % 4, (turn + 3) % 4);
  }

  void add(int x, int y, int side, int other) {
    const std::size_t k = pieces_.size();
    pieces_.push_back({on_side(x, y, side), on_side(x, y, other)});
    for (const Crossing& end : pieces_.back()) at_edge_[end.edge].push_back(k);
  }

  /// The segment on the other side of an edge, if any.
  bool next_piece(std::uint64_t edge, std::size_t& next) const {
    for (const std::size_t k : at_edge_.at(edge))
      if (!used_[k]) return next = k, true;
    return false;
  }

  Line follow(std::size_t first) {
    used_[first] = true;
    Line line{pieces_[first][0], pieces_[first][1]};
    for (const bool forwards : {true, false}) {
      Line way;
      std::uint64_t edge = forwards ? line.back().edge : line.front().edge;
      for (std::size_t k = 0; next_piece(edge, k);) {
        used_[k] = true;
        const Crossing& end = pieces_[k][pieces_[k][0].edge == edge ? 1 : 0];
        way.push_back(end);
        edge = end.edge;
      }
      if (forwards)
        line.insert(line.end(), way.begin(), way.end());
      else
        line.insert(line.begin(), way.rbegin(), way.rend());
    }
    return line;
  }

  const Raster<float>& z_;
  double level_;
  std::vector<std::array<Crossing, 2>> pieces_;
  std::vector<bool> used_;
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> at_edge_;
};

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

std::vector<Level> levels_of(double lowest_m, double highest_m, const ContourLineOptions& options) {
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

}  // namespace

Result<std::string> encode_contour_lines(const Raster<float>& heights_m, double pixel_m,
                                         const ContourLineOptions& options) {
  constexpr double kMostLines = 200.0;
  const auto [low, high] = std::minmax_element(heights_m.values().begin(), heights_m.values().end());
  const double lowest_m{*low}, highest_m{*high}, range = highest_m - lowest_m;
  if (!(options.interval_m > 0.0) || range / options.interval_m > kMostLines)
    return Error{
        ErrorCode::usage, "the height from line to line must be above 0 and give at most 200 lines", {}};
  if (!(options.line_width_m >= 0.00005 && options.line_width_m <= 0.01))
    return Error{ErrorCode::usage, "the lines must be 0.05 to 10 mm wide", {}};
  if ((options.outline_m && !(*options.outline_m > 0.0)) ||
      !(options.least_length_m >= 0.0 && options.least_length_m <= 0.1))
    return Error{ErrorCode::usage, "an outline must be above 0, and the shortest line 0 to 100 mm", {}};
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
  for (const Level& level : levels_of(lowest_m, highest_m, options)) {
    for (const Line& line : LevelTracer(heights_m, level.height_m).lines()) {
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
