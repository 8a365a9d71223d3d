// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/formats/tactile/height_lines.hpp"

#include "palpable/core/picture/level_lines.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

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
  if ((options.outline_m && !(*options.outline_m > 0.0)) ||
      !(options.least_length_m >= 0.0 && options.least_length_m <= 0.1) ||
      !(options.smooth_m >= 0.0 && options.smooth_m <= 0.1))
    return Error{ErrorCode::usage,
                 "an outline must be above 0, the shortest line and the width of smoothing 0 to 100 mm",
                 {}};
  return {};
}

/// The mean of the samples within `reach` on both sides along rows; the border's values go on beyond it.
Raster<float> averaged_along_rows(const Raster<float>& values, int reach) {
  Raster<float> means(values.width(), values.height());
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) {
      double sum = 0.0;
      for (int k = -reach; k <= reach; ++k) sum += values(std::clamp(x + k, 0, values.width() - 1), y);
      means(x, y) = static_cast<float>(sum / (2 * reach + 1));
    }
  return means;
}

Raster<float> transposed(const Raster<float>& values) {
  Raster<float> turned(values.height(), values.width());
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x) turned(y, x) = values(x, y);
  return turned;
}

/// Averaged twice along rows and columns, which is nearly as round as a Gaussian.
Raster<float> smoothed(Raster<float> heights_m, int reach) {
  for (int k = 0; k < 4; ++k) heights_m = transposed(averaged_along_rows(heights_m, reach));
  return heights_m;
}

/// With one more sample on each side.
Raster<float> framed(const Raster<float>& heights_m, float around_m) {
  Raster<float> out(heights_m.width() + 2, heights_m.height() + 2, around_m);
  for (int y = 0; y < heights_m.height(); ++y)
    std::copy(heights_m.row(y).begin(), heights_m.row(y).end(), out.row(y + 1).begin() + 1);
  return out;
}

}  // namespace

Result<std::vector<HeightLine>> height_lines(const Raster<float>& heights_m, double pixel_m,
                                             const HeightLineOptions& options) {
  const Range range = range_of(heights_m);
  if (const auto checked = check(options, range); !checked) return checked.error();
  const int reach = static_cast<int>(std::lround(0.25 * options.smooth_m / pixel_m));
  Raster<float> heights = reach > 0 ? smoothed(heights_m, reach) : heights_m;
  if (options.beyond == HeightLineOptions::Beyond::lowest)
    heights = framed(heights, static_cast<float>(range.lowest_m));
  // A line along the border lies on it.
  const double right_m = 0.5 * heights_m.width() * pixel_m, top_m = 0.5 * heights_m.height() * pixel_m;
  std::vector<HeightLine> lines;
  for (const Level& level : levels_of(range.lowest_m, range.highest_m, options))
    for (const Line& line : level_lines(heights, level.height_m)) {
      if (length_of(line) * pixel_m < options.least_length_m) continue;
      HeightLine& added = lines.emplace_back(HeightLine{{}, level.width});
      for (const RasterPoint& point : line)
        added.line.points.push_back(
            {std::clamp((point.x + 0.5 - 0.5 * heights.width()) * pixel_m, -right_m, right_m),
             std::clamp((0.5 * heights.height() - point.y - 0.5) * pixel_m, -top_m, top_m), 0.0});
    }
  std::stable_sort(lines.begin(), lines.end(), [](const HeightLine& a, const HeightLine& b) {
    return std::pair(-a.weight, -palpable::length_of(a.line)) <
           std::pair(-b.weight, -palpable::length_of(b.line));
  });
  return lines;
}

}  // namespace palpable::formats
