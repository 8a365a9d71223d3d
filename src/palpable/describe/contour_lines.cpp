// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/describe/contour_lines.hpp"

#include "palpable/core/raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace palpable::describe {
namespace {

constexpr int kLongestLineSide = 512;
using Mask = Raster<std::uint8_t>;

double strength_of(const models::BoundaryPixel& pixel) {
  return std::hypot(double{pixel.c2}, double{pixel.s2});
}

/// Where the lines are, with a border of one empty pixel, `step` pixels of the map taken together.
Mask mask_of(const models::BoundaryMap& map, int step) {
  const auto& edges = map.edges();
  Mask mask((edges.width() + step - 1) / step + 2, (edges.height() + step - 1) / step + 2, 0);
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x)
      if (strength_of(edges(x, y)) >= map.origin().threshold) mask(x / step + 1, y / step + 1) = 1;
  return mask;
}

/// Clockwise from above.
constexpr std::array<std::array<int, 2>, 8> kAround{
    {{0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}}};

/// Whether Zhang & Suen's step (0 or 1) takes the pixel away.
bool is_removed(const Mask& mask, int x, int y, int step) {
  std::array<bool, 8> on{};
  int neighbours = 0, changes = 0;
  for (std::size_t k = 0; k < on.size(); ++k) on[k] = mask(x + kAround[k][0], y + kAround[k][1]) != 0;
  for (std::size_t k = 0; k < on.size(); ++k) {
    neighbours += on[k] ? 1 : 0;
    changes += !on[k] && on[(k + 1) % 8] ? 1 : 0;
  }
  if (neighbours < 2 || neighbours > 6 || changes != 1) return false;
  return step == 0 ? !(on[0] && on[2] && on[4]) && !(on[2] && on[4] && on[6])
                   : !(on[0] && on[2] && on[6]) && !(on[0] && on[4] && on[6]);
}

void thin(Mask& mask) {
  std::vector<std::size_t> removed;
  bool changed = true;
  while (changed) {
    changed = false;
    for (const int step : {0, 1}) {
      removed.clear();
      for (int y = 1; y + 1 < mask.height(); ++y)
        for (int x = 1; x + 1 < mask.width(); ++x)
          if (mask(x, y) != 0 && is_removed(mask, x, y, step))
            removed.push_back(static_cast<std::size_t>(y) * static_cast<std::size_t>(mask.width()) +
                              static_cast<std::size_t>(x));
      for (const std::size_t i : removed) mask.values()[i] = 0;
      changed = changed || !removed.empty();
    }
  }
}

/// Marks what is connected to `start` in `marks` and returns it. `diagonal`: over eight neighbours, not four.
std::vector<Pixel> flood(const Mask& mask, Pixel start, int mark, Raster<int>& marks, bool diagonal) {
  std::vector<Pixel> found{start};
  const std::uint8_t value = mask(start.x, start.y);
  marks(start.x, start.y) = mark;
  for (std::size_t k = 0; k < found.size(); ++k) {
    for (std::size_t n = 0; n < kAround.size(); n += diagonal ? 1 : 2) {
      const Pixel next{found[k].x + kAround[n][0], found[k].y + kAround[n][1]};
      if (next.x < 0 || next.y < 0 || next.x >= mask.width() || next.y >= mask.height()) continue;
      if (mask(next.x, next.y) != value || marks(next.x, next.y) != 0) continue;
      marks(next.x, next.y) = mark;
      found.push_back(next);
    }
  }
  return found;
}

/// In pixels: each connection between neighbours once. A diagonal counts where no two straight ones replace
/// it, and where they do, the corner between them is cut: thinning leaves stairs on slanted lines.
double length_of(const Mask& mask, const std::vector<Pixel>& pixels) {
  double length = 0.0;
  for (const Pixel p : pixels) {
    const bool right = mask(p.x + 1, p.y) != 0, below = mask(p.x, p.y + 1) != 0;
    const bool left = mask(p.x - 1, p.y) != 0, above = mask(p.x, p.y - 1) != 0;
    length += (right ? 1.0 : 0.0) + (below ? 1.0 : 0.0);
    if (right != left && below != above) length -= 1.0 - 0.5 * std::numbers::sqrt2;
    if (mask(p.x + 1, p.y + 1) != 0 && !right && !below) length += std::numbers::sqrt2;
    if (mask(p.x - 1, p.y + 1) != 0 && !left && !below) length += std::numbers::sqrt2;
  }
  return length;
}

/// Closes the lines that enclose an area: the first pixel of an enclosed area in reading order lies below the
/// line around it.
void mark_closed(const Mask& mask, const Raster<int>& line_of, std::vector<ContourLine>& lines) {
  // Smaller areas are gaps between the pixels of one line.
  constexpr std::size_t kLeastArea = 9;
  Raster<int> areas(mask.width(), mask.height(), 0);
  flood(mask, {0, 0}, 1, areas, false);
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) != 0 || areas(x, y) != 0) continue;
      if (flood(mask, {x, y}, 2, areas, false).size() < kLeastArea) continue;
      const int line = line_of(x, y - 1);
      if (line > 0) lines[static_cast<std::size_t>(line) - 1].closed = true;
    }
}

}  // namespace

std::vector<ContourLine> find_contour_lines(const models::BoundaryMap& map,
                                            const ContourLineOptions& options) {
  const auto& edges = map.edges();
  const int step = (std::max(edges.width(), edges.height()) + kLongestLineSide - 1) / kLongestLineSide;
  Mask mask = mask_of(map, step);
  thin(mask);
  const double pixel_m = step * map.pixel_m();
  // The border pixel is no part of the map.
  const auto place_of = [&](int x, int y) {
    return Place{(x - 0.5) * pixel_m - 0.5 * map.width_m(), 0.5 * map.depth_m() - (y - 0.5) * pixel_m};
  };
  Raster<int> line_of(mask.width(), mask.height(), 0);
  std::vector<ContourLine> lines;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x) {
      if (mask(x, y) == 0 || line_of(x, y) != 0) continue;
      const auto pixels = flood(mask, {x, y}, static_cast<int>(lines.size()) + 1, line_of, true);
      ContourLine line;
      line.length_m = pixel_m * length_of(mask, pixels);
      const auto [left, right] =
          std::minmax_element(pixels.begin(), pixels.end(), [](Pixel a, Pixel b) { return a.x < b.x; });
      const auto [top, bottom] =
          std::minmax_element(pixels.begin(), pixels.end(), [](Pixel a, Pixel b) { return a.y < b.y; });
      line.least = place_of(left->x, bottom->y);
      line.most = place_of(right->x, top->y);
      lines.push_back(line);
    }
  mark_closed(mask, line_of, lines);
  const double least_m = options.least_length * std::max(map.width_m(), map.depth_m());
  std::erase_if(lines, [least_m](const ContourLine& line) { return line.length_m < least_m; });
  std::stable_sort(lines.begin(), lines.end(),
                   [](const ContourLine& a, const ContourLine& b) { return a.length_m > b.length_m; });
  return lines;
}

std::optional<NearestLine> nearest_line(const models::BoundaryMap& map, Place place, double reach_m) {
  const auto& edges = map.edges();
  const double pixel_m = map.pixel_m();
  const double column = (place.x_m + 0.5 * map.width_m()) / pixel_m - 0.5,
               row = (0.5 * map.depth_m() - place.y_m) / pixel_m - 0.5;
  const auto first = [](double centre, double reach) {
    return std::max(0, static_cast<int>(std::ceil(centre - reach)));
  };
  const auto last = [](double centre, double reach, int count) {
    return std::min(count - 1, static_cast<int>(std::floor(centre + reach)));
  };
  const double reach = std::min(reach_m / pixel_m, 1e6);
  double nearest = reach * reach;
  std::optional<NearestLine> found;
  for (int y = first(row, reach); y <= last(row, reach, edges.height()); ++y)
    for (int x = first(column, reach); x <= last(column, reach, edges.width()); ++x) {
      const double squared = (x - column) * (x - column) + (y - row) * (y - row);
      if (squared > nearest || strength_of(edges(x, y)) < map.origin().threshold) continue;
      nearest = squared;
      const double doubled = std::atan2(double{edges(x, y).s2}, double{edges(x, y).c2});
      found = NearestLine{(x - column) * pixel_m, (row - y) * pixel_m,
                          0.5 * (doubled < 0.0 ? doubled + 2.0 * std::numbers::pi : doubled)};
    }
  return found;
}

}  // namespace palpable::describe
