// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/contours/contour_options.hpp"

#include <cmath>
#include <utility>

namespace palpable::vision {

/// A symmetric 2 x 2 tensor per pixel: sums of n n^T over edge vectors n, image axes.
struct TensorMap {
  Raster<float> xx;
  Raster<float> xy;
  Raster<float> yy;
};

/// The unit direction whose doubled angle has the direction of (c, s), in the right half plane; zero for (0,
/// 0).
inline std::pair<float, float> halve_angle(float c, float s) {
  const float length = std::sqrt(c * c + s * s);
  if (!(length > 0.0F)) return {0.0F, 0.0F};
  const float larger = std::sqrt(0.5F + 0.5F * std::abs(c) / length);
  const float smaller = 0.5F * std::abs(s) / (length * larger);
  return c >= 0.0F ? std::pair{larger, std::copysign(smaller, s)}
                   : std::pair{smaller, std::copysign(larger, s)};
}

/// Otsu's threshold (1979) over values in 0 ... 1, 256 levels, level 0 included; sums as corrected in the
/// paper's section 3.2.
double otsu_threshold(const Raster<float>& values);

/// Bilinear interpolation at (x, y), pixels; beyond the border, the outermost pixel's value. The raster has
/// at least 2 x 2 pixels.
float bilinear(const Raster<float>& values, float x, float y);

/// Ridges of `strength` across the tangent, one pixel wide, by non-maximum suppression and hysteresis: a line
/// must reach `threshold` and is followed down to the followed share of it. Corners are restored
/// (contour_corners.hpp).
Raster<float> ridge_lines(const Raster<float>& strength, const Raster<float>& tangent_x,
                          const Raster<float>& tangent_y, double threshold, const LineOptions& options,
                          const Work& work);

}  // namespace palpable::vision
