// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/boundary_map.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::models {

Result<BoundaryMap> BoundaryMap::from_pixels(Raster<BoundaryPixel> pixels, double pixel_m) {
  if (pixels.width() < 2 || pixels.height() < 2)
    return invalid_input("a boundary map needs at least 2 x 2 pixels");
  if (pixels.count() > 64'000'000) return invalid_input("a boundary map may have at most 64 million pixels");
  if (!(pixel_m > 0.0 && pixel_m <= 1.0))
    return invalid_input("the pixel size of a boundary map must be above 0 and at most 1 m");
  for (const BoundaryPixel& p : pixels.values()) {
    const float square = p.c2 * p.c2 + p.s2 * p.s2;
    if (!(square <= 1.001F))
      return invalid_input("a boundary map has a strength that is not between 0 and 1");
  }
  BoundaryMap map;
  map.pixels_ = std::move(pixels);
  map.pixel_m_ = pixel_m;
  return map;
}

BoundarySample BoundaryMap::sample(double x_m, double y_m) const noexcept {
  const double u = x_m / pixel_m_ + 0.5 * (pixels_.width() - 1);
  const double v = -y_m / pixel_m_ + 0.5 * (pixels_.height() - 1);
  if (!(u >= 0.0 && v >= 0.0 && u <= pixels_.width() - 1 && v <= pixels_.height() - 1)) return {};
  const int i = std::min(static_cast<int>(u), pixels_.width() - 2);
  const int j = std::min(static_cast<int>(v), pixels_.height() - 2);
  const double a = u - i;
  const double b = v - j;
  const BoundaryPixel& p00 = pixels_(i, j);
  const BoundaryPixel& p10 = pixels_(i + 1, j);
  const BoundaryPixel& p01 = pixels_(i, j + 1);
  const BoundaryPixel& p11 = pixels_(i + 1, j + 1);
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
