// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/pixel_planes.hpp"

#include <cmath>

namespace palpable::vision {
namespace {

constexpr int kStep_px = 2;

/// The slope of a value between its neighbours before and after: the mean of both sides if they are alike,
/// else the flatter one, since the other is an edge.
float slope(float before, float value, float after) {
  const float a = (value - before) / kStep_px;
  const float b = (after - value) / kStep_px;
  if (std::isnan(a)) return b;
  if (std::isnan(b)) return a;
  // Noise is up to some percent of the inverse depth.
  constexpr float kAlikeShare = 0.02F;
  if (std::abs(a - b) <= kAlikeShare * value) return 0.5F * (a + b);
  return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

Raster<PixelPlane> pixel_planes(const Raster<float>& depth_m, const Pinhole& camera) {
  Raster<PixelPlane> planes(depth_m.width(), depth_m.height());
  const auto inverse = [&](int x, int y) {
    return depth_m.contains(x, y) ? 1.0F / depth_m(x, y) : kUnknownDepth;
  };
  for (int y = 0; y < depth_m.height(); ++y)
    for (int x = 0; x < depth_m.width(); ++x) {
      if (!(depth_m(x, y) > 0.0F)) continue;
      const float q = inverse(x, y);
      const float qx = slope(inverse(x - kStep_px, y), q, inverse(x + kStep_px, y));
      const float qy = slope(inverse(x, y - kStep_px), q, inverse(x, y + kStep_px));
      if (std::isnan(qx) || std::isnan(qy)) continue;
      // The plane's normal is along (fx qx, fy qy, q - (x - cx) qx - (y - cy) qy); its product with the ray
      // (.., .., 1) is q.
      const float nx = static_cast<float>(camera.fx) * qx;
      const float ny = static_cast<float>(camera.fy) * qy;
      const float nz = q - static_cast<float>(x - camera.cx) * qx - static_cast<float>(y - camera.cy) * qy;
      planes(x, y) = {q, qx, qy, q / std::sqrt(nx * nx + ny * ny + nz * nz)};
    }
  return planes;
}

}  // namespace palpable::vision
