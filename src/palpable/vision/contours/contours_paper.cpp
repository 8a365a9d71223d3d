// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/edge_response.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace palpable::vision {
namespace {

using Mask = std::array<float, 9>;  // row by row, y downwards

// Gradient masks. Sobel's responds with 8 to a unit ramp and with 4 to a unit step.
constexpr Mask kSobelX{-1, 0, 1, -2, 0, 2, -1, 0, 1};
constexpr Mask kSobelY{-1, -2, -1, 0, 0, 0, 1, 2, 1};
// Eq. 4 (Climent et al. 1998), correct as printed: it is chiral and valid for gradients between atan(1/3) and
// 45 degrees (y down).
constexpr Mask kClimentX{-123, 25, 74, -254, 0, 254, -74, -25, 123};
constexpr Mask kClimentY{-74, -254, -123, -25, 0, 25, 123, 254, 74};
// Its vertical mirror, for the steeper half of the quadrant.
constexpr Mask kMirrorX{-74, -25, 123, -254, 0, 254, -123, 25, 74};
constexpr Mask kMirrorY{-123, -254, -74, 25, 0, -25, 74, 254, 123};

/// The mask's response at a pixel; beyond the border the outermost pixels' values.
float response(const Raster<float>& image, int x, int y, const Mask& mask) {
  float sum = 0.0F;
  for (int j = -1; j <= 1; ++j) {
    for (int i = -1; i <= 1; ++i) {
      const int u = std::clamp(x + i, 0, image.width() - 1);
      const int v = std::clamp(y + j, 0, image.height() - 1);
      sum += mask[static_cast<std::size_t>(3 * (j + 1) + i + 1)] * image(u, v);
    }
  }
  return sum;
}

/// The gradient's angle by Sobel's masks, or by Climent's if Sobel's angle is between atan(1/3) and its
/// complement within the quadrant.
double gradient_angle(const Raster<float>& image, int x, int y, float ex, float ey) {
  constexpr double kLow = 18.43494882292201;
  const double sobel = std::atan2(ey, ex);
  const double in_quadrant = std::fmod(sobel * 180.0 / std::numbers::pi + 360.0, 90.0);
  if (in_quadrant < kLow || in_quadrant > 90.0 - kLow) return sobel;
  const bool lower = in_quadrant <= 45.0;
  return std::atan2(response(image, x, y, lower ? kClimentY : kMirrorY),
                    response(image, x, y, lower ? kClimentX : kMirrorX));
}

}  // namespace

EdgeResponse paper_edges(const Image& image, const Work& work) {
  const Raster<float> values = grey(image);
  EdgeResponse out{Raster<float>(image.width, image.height), Raster<float>(image.width, image.height),
                   Raster<float>(image.width, image.height)};
  parallel_for(work, image.height, 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const float ex = response(values, x, y, kSobelX);
        const float ey = response(values, x, y, kSobelY);
        const float magnitude = std::sqrt(ex * ex + ey * ey);  // eq. 3 with its squares
        if (magnitude <= 0.0F) continue;
        const double angle = gradient_angle(values, x, y, ex, ey);
        out.tangent_x(x, y) = static_cast<float>(-std::sin(angle));
        out.tangent_y(x, y) = static_cast<float>(std::cos(angle));
        out.strength(x, y) = std::min(1.0F, magnitude / 4.0F);
      }
    }
  });
  return out;
}

}  // namespace palpable::vision
