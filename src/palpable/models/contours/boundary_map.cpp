// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/contours/boundary_map.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

namespace palpable::models {

namespace {

struct Tap {
  int dx;
  int dy;
  float weight;
};

/// The window n(r) of eq. 7, normalised to sum 1.
std::vector<Tap> window(double radius_px) {
  const int r = static_cast<int>(std::ceil(radius_px));
  std::vector<Tap> taps;
  float total = 0.0F;
  for (int dy = -r; dy <= r; ++dy) {
    for (int dx = -r; dx <= r; ++dx) {
      const auto weight = static_cast<float>(1.0 - std::hypot(dx, dy) / radius_px);
      if (weight <= 0.0F) continue;
      taps.push_back({dx, dy, weight});
      total += weight;
    }
  }
  for (Tap& tap : taps) tap.weight /= total;
  return taps;
}

/// Filters one row with the taps; pixels beyond the border are zero.
void average_row(const Raster<BoundaryPixel>& edges, int y, const std::vector<Tap>& taps,
                 std::span<BoundaryPixel> out) {
  const int w = edges.width();
  for (const Tap& tap : taps) {
    if (y + tap.dy < 0 || y + tap.dy >= edges.height()) continue;
    const auto row = edges.row(y + tap.dy);
    for (int x = std::max(0, -tap.dx); x < std::min(w, w - tap.dx); ++x) {
      out[static_cast<std::size_t>(x)].c2 += tap.weight * row[static_cast<std::size_t>(x + tap.dx)].c2;
      out[static_cast<std::size_t>(x)].s2 += tap.weight * row[static_cast<std::size_t>(x + tap.dx)].s2;
    }
  }
}

Result<void> check(const Raster<BoundaryPixel>& edges, double pixel_m, double radius_px) {
  if (edges.width() < 2 || edges.height() < 2)
    return invalid_input("a boundary map needs at least 2 x 2 pixels");
  if (edges.count() > 64'000'000) return invalid_input("a boundary map may have at most 64 million pixels");
  if (!(pixel_m > 0.0 && pixel_m <= 1.0))
    return invalid_input("the pixel size of a boundary map must be above 0 and at most 1 m");
  if (!(radius_px >= 1.0 && radius_px <= 32.0))
    return invalid_input("the neighbourhood of a boundary map must be 1 to 32 pixels");
  for (const BoundaryPixel& p : edges.values())
    if (!(p.c2 * p.c2 + p.s2 * p.s2 <= 1.001F))
      return invalid_input("a boundary map has a strength that is not between 0 and 1");
  return {};
}

}  // namespace

Result<BoundaryMap> BoundaryMap::from_edges(Raster<BoundaryPixel> edges, double pixel_m, double radius_px,
                                            const BoundaryOrigin& origin, const Work& work) {
  if (const auto valid = check(edges, pixel_m, radius_px); !valid) return valid.error();
  BoundaryMap map;
  map.averaged_ = Raster<BoundaryPixel>(edges.width(), edges.height());
  const std::vector<Tap> taps = window(radius_px);
  parallel_for(work, edges.height(), 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) average_row(edges, y, taps, map.averaged_.row(y));
  });
  map.edges_ = std::move(edges);
  map.origin_ = origin;
  map.radius_px_ = radius_px;
  map.pixel_m_ = pixel_m;
  return map;
}

BoundarySample BoundaryMap::sample(double x_m, double y_m) const noexcept {
  const double u = x_m / pixel_m_ + 0.5 * (averaged_.width() - 1);
  const double v = -y_m / pixel_m_ + 0.5 * (averaged_.height() - 1);
  if (!(u >= 0.0 && v >= 0.0 && u <= averaged_.width() - 1 && v <= averaged_.height() - 1)) return {};
  const int i = std::min(static_cast<int>(u), averaged_.width() - 2);
  const int j = std::min(static_cast<int>(v), averaged_.height() - 2);
  const double a = u - i;
  const double b = v - j;
  const BoundaryPixel& p00 = averaged_(i, j);
  const BoundaryPixel& p10 = averaged_(i + 1, j);
  const BoundaryPixel& p01 = averaged_(i, j + 1);
  const BoundaryPixel& p11 = averaged_(i + 1, j + 1);
  const double c = (1 - b) * ((1 - a) * p00.c2 + a * p10.c2) + b * ((1 - a) * p01.c2 + a * p11.c2);
  const double s = (1 - b) * ((1 - a) * p00.s2 + a * p10.s2) + b * ((1 - a) * p01.s2 + a * p11.s2);
  const double length = std::sqrt(c * c + s * s);
  if (!(length > 0.0)) return {};
  const double larger = std::sqrt(0.5 + 0.5 * std::abs(c) / length);
  const double smaller = 0.5 * std::abs(s) / (length * larger);
  if (c >= 0.0) return {larger, std::copysign(smaller, s), length};
  return {smaller, std::copysign(larger, s), length};
}

}  // namespace palpable::models
