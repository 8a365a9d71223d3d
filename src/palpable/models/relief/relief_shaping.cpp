// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace palpable::models {
namespace {

struct Neighbour {
  int dx;
  int dy;
};

// The half of the sixteen directions (king's and knight's moves of chess) that a downward pass has already
// visited.
constexpr std::array<Neighbour, 8> kVisited{
    {{-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {-2, -1}, {2, -1}, {-1, -2}, {1, -2}}};

// Limits along sixteen directions bound the gradient only to an octagon around the slope's circle: 1/cos(22.5
// deg) times the limit at its corners.
constexpr double kBetweenDirections = 1.0824;

/// Lowers `low` to the greatest function below it that rises by at most `step` per pixel: two passes of a
/// grey-weighted distance transform (Borgefors 1986).
void lower_to_slope(Raster<float>& low, double step) {
  const int w = low.width();
  const int h = low.height();
  std::array<float, kVisited.size()> costs;
  for (std::size_t k = 0; k < costs.size(); ++k)
    costs[k] = static_cast<float>(step * std::hypot(kVisited[k].dx, kVisited[k].dy));
  const auto pass = [&](int sign, int y) {
    const bool whole_rows = y - 2 * sign >= 0 && y - 2 * sign < h;
    for (int k = 0; k < w; ++k) {
      const int x = sign > 0 ? k : w - 1 - k;
      const bool inside = whole_rows && x >= 2 && x + 2 < w;
      float z = low(x, y);
      for (std::size_t n = 0; n < costs.size(); ++n) {
        const int a = x + sign * kVisited[n].dx;
        const int b = y + sign * kVisited[n].dy;
        if (inside || low.contains(a, b)) z = std::min(z, low(a, b) + costs[n]);
      }
      low(x, y) = z;
    }
  };
  for (int y = 0; y < h; ++y) pass(1, y);
  for (int y = h - 1; y >= 0; --y) pass(-1, y);
}

void negate(Raster<float>& values) {
  for (float& v : values.values()) v = -v;
}

/// Raises `high` to the lowest function above it that rises by at most `step` per pixel.
void raise_to_slope(Raster<float>& high, double step) {
  negate(high);
  lower_to_slope(high, step);
  negate(high);
}

/// The mean of both functions: within `step` per pixel, but a step gets half the slope on either side.
Raster<float> between_slopes(const Raster<float>& heights, double step) {
  Raster<float> lower = heights;
  Raster<float> mean = heights;
  lower_to_slope(lower, step);
  raise_to_slope(mean, step);
  for (std::size_t i = 0; i < mean.count(); ++i) mean.data()[i] = 0.5F * (mean.data()[i] + lower.data()[i]);
  return mean;
}

/// The mean over 2 radius + 1 values of a line, whose ends continue.
void average_line(std::vector<double>& line, std::vector<double>& sums, int radius) {
  const auto n = static_cast<int>(line.size());
  const auto at = [&](int k) { return line[static_cast<std::size_t>(std::clamp(k, 0, n - 1))]; };
  double sum = 0.0;
  for (int k = -radius; k <= radius; ++k) sum += at(k);
  for (int k = 0; k < n; ++k) {
    sums[static_cast<std::size_t>(k)] = sum / (2 * radius + 1);
    sum += at(k + radius + 1) - at(k - radius);
  }
  line.swap(sums);
}

/// Applies `change` to every line of a raster along one axis.
template <class Change>
void change_lines(Raster<float>& z, bool rows, Change&& change) {
  const int lines = rows ? z.height() : z.width();
  const int length = rows ? z.width() : z.height();
  std::vector<double> line(static_cast<std::size_t>(length));
  for (int k = 0; k < lines; ++k) {
    for (int i = 0; i < length; ++i) line[static_cast<std::size_t>(i)] = double{rows ? z(i, k) : z(k, i)};
    change(line);
    for (int i = 0; i < length; ++i)
      (rows ? z(i, k) : z(k, i)) = static_cast<float>(line[static_cast<std::size_t>(i)]);
  }
}

}  // namespace

void limit_slope(Raster<float>& height_m, double pixel_m, double steepest_slope) {
  PALPABLE_CHECK(pixel_m > 0.0 && steepest_slope > 0.0);
  const double step = steepest_slope * pixel_m / kBetweenDirections;
  const Raster<float> middle = between_slopes(height_m, step);
  Raster<float> high = middle;
  Raster<float> low = middle;
  for (std::size_t i = 0; i < middle.count(); ++i) {
    const float z = height_m.data()[i];
    (z > middle.data()[i] ? high : low).data()[i] = z;
  }
  lower_to_slope(high, step);
  raise_to_slope(low, step);
  // Where the heights were above the middle, `low` is the middle itself, and vice versa.
  for (std::size_t i = 0; i < middle.count(); ++i)
    height_m.data()[i] = height_m.data()[i] > middle.data()[i] ? high.data()[i] : low.data()[i];
  // Both parts join within the limit, except at single pixel corners.
  height_m = between_slopes(height_m, step);
}

void cut_to_slope(Raster<float>& height_m, double pixel_m, double steepest_slope) {
  PALPABLE_CHECK(pixel_m > 0.0 && steepest_slope > 0.0);
  lower_to_slope(height_m, steepest_slope * pixel_m / kBetweenDirections);
}

void smooth_heights(Raster<float>& height_m, int radius_px) {
  PALPABLE_CHECK(radius_px >= 0);
  if (radius_px == 0) return;
  constexpr int kMeans = 3;
  std::vector<double> sums;
  for (const bool rows : {true, false})
    change_lines(height_m, rows, [&](std::vector<double>& line) {
      sums.resize(line.size());
      for (int k = 0; k < kMeans; ++k) average_line(line, sums, radius_px);
    });
}

double greatest_bend_per_m(const Raster<float>& height_m, double pixel_m) {
  const int w = height_m.width(), h = height_m.height();
  const auto at = [&](int x, int y) {
    return double{height_m(std::clamp(x, 0, w - 1), std::clamp(y, 0, h - 1))};
  };
  double greatest = 0.0;
  for (int y = 0; y < h; ++y)
    for (int x = 0; x < w; ++x) {
      const double z = at(x, y);
      const double along_x = at(x - 1, y) - 2.0 * z + at(x + 1, y);
      const double along_y = at(x, y - 1) - 2.0 * z + at(x, y + 1);
      const double mixed = 0.25 * (at(x + 1, y + 1) - at(x - 1, y + 1) - at(x + 1, y - 1) + at(x - 1, y - 1));
      const double mean = 0.5 * (along_x + along_y);
      greatest = std::max(greatest, std::abs(mean) + std::hypot(0.5 * (along_x - along_y), mixed));
    }
  return greatest / (pixel_m * pixel_m);
}

}  // namespace palpable::models
