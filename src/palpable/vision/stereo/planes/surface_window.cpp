// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/surface_window.hpp"

#include "palpable/core/numbers/vectorize.hpp"

#include <cmath>

namespace palpable::vision {

SurfaceRow surface_row(const ColourPlanes& colour, const PlaneMap& map, const Raster<float>& weight, int x,
                       int y) {
  const auto at = [&](const auto& raster) { return raster.row(y).data() + x; };
  return {at(map.disparity), at(map.slope_x), at(map.slope_y), at(weight),
          at(colour.r),      at(colour.g),    at(colour.b)};
}

PALPABLE_VECTORIZE
void surface_weights(const SurfaceRow& centre, const SurfaceRow& other, Offset offset,
                     const FitWindow& window, int count, float* __restrict weight, float* __restrict rise) {
  const auto dx = static_cast<float>(offset.x);
  const auto dy = static_cast<float>(offset.y);
  const float per_tolerance =
      1.0F / (window.tolerance_px + window.tolerance_per_px * (std::fabs(dx) + std::fabs(dy)));
  const float per_colour2 = 1.0F / (window.half_weight_levels * window.half_weight_levels);
  const float* __restrict d0 = centre.disparity;
  const float* __restrict d1 = other.disparity;
  const float* __restrict sx = centre.slope_x;
  const float* __restrict sy = centre.slope_y;
  const float* __restrict w1 = other.weight;
  const std::uint8_t* __restrict r0 = centre.r;
  const std::uint8_t* __restrict g0 = centre.g;
  const std::uint8_t* __restrict b0 = centre.b;
  const std::uint8_t* __restrict r1 = other.r;
  const std::uint8_t* __restrict g1 = other.g;
  const std::uint8_t* __restrict b1 = other.b;
  for (int x = 0; x < count; ++x) {
    const float z = d1[x] - d0[x];
    const float departure = std::fabs(z - (sx[x] * dx + sy[x] * dy)) * per_tolerance;
    const int dr = std::abs(r0[x] - r1[x]);
    const int dg = std::abs(g0[x] - g1[x]);
    const int db = std::abs(b0[x] - b1[x]);
    int c = dr > dg ? dr : dg;
    c = c > db ? c : db;
    const float q = static_cast<float>(c * c) * per_colour2;
    const float near = 1.0F - departure;
    weight[x] = (near > 0.0F ? near : 0.0F) * w1[x] / (1.0F + q * q);
    rise[x] = z;
  }
}

}  // namespace palpable::vision
