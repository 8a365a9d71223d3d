// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_shaping.hpp"

#include "palpable/core/vectorize.hpp"

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

/// best[x] = max(best[x], from[x] + rise).
PALPABLE_VECTORIZE void raise(float* best, const float* from, int count, float rise) {
  for (int x = 0; x < count; ++x) best[x] = std::max(best[x], from[x] + rise);
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

Raster<float> dilate_by_ball(const Raster<float>& height_m, double pixel_m, double radius_m,
                             const Work& work) {
  PALPABLE_CHECK(pixel_m > 0.0 && radius_m >= 0.0);
  const double reach = radius_m / pixel_m;
  const int r = static_cast<int>(std::floor(reach));
  const int w = height_m.width();
  const int h = height_m.height();
  Raster<float> centre(w, h);
  parallel_for(work, h, 8, [&](int begin, int end) {
    std::vector<float> padded(static_cast<std::size_t>(w + 2 * r));
    for (int y = begin; y < end; ++y) {
      float* best = centre.row(y).data();
      const auto own = height_m.row(y);
      for (int x = 0; x < w; ++x) best[x] = own[static_cast<std::size_t>(x)] + static_cast<float>(radius_m);
      for (int dy = -r; dy <= r; ++dy) {
        const auto row = height_m.row(std::clamp(y + dy, 0, h - 1));
        std::copy(row.begin(), row.end(), padded.begin() + r);
        std::fill_n(padded.begin(), r, row.front());
        std::fill_n(padded.end() - r, r, row.back());
        const int chord = static_cast<int>(std::floor(std::sqrt(reach * reach - dy * dy)));
        for (int dx = -chord; dx <= chord; ++dx) {
          const double rise = pixel_m * std::sqrt(std::max(0.0, reach * reach - dx * dx - dy * dy));
          raise(best, padded.data() + r + dx, w, static_cast<float>(rise));
        }
      }
    }
  });
  return centre;
}

}  // namespace palpable::models
