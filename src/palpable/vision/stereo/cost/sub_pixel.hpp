// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/core/work.hpp"

#include <algorithm>

namespace palpable::vision {

/// Offset from d to the minimum of the parabola through the costs at d - 1, d and d + 1, within ± 1/2; 0 at
/// the ends of the range and if the costs are not convex.
template <class Cost>
float sub_pixel_offset(const Cost* costs, int d, int count) {
  if (d == 0 || d + 1 >= count) return 0.0F;
  const auto below = static_cast<float>(costs[d - 1]);
  const auto above = static_cast<float>(costs[d + 1]);
  const float curvature = below + above - 2.0F * static_cast<float>(costs[d]);
  if (curvature <= 0.0F) return 0.0F;
  return std::clamp(0.5F * (below - above) / curvature, -0.5F, 0.5F);
}

/// The smoothest surface within half a pixel of integer disparities: a membrane, cut where neighbouring
/// labels differ by more than one. It restores slopes without the noise of sub-pixel parabolas on plain
/// surfaces. `iterations` >= 0 of Jacobi's method.
Raster<float> membrane_through(const Raster<int>& label_px, int iterations, const Work& work);

}  // namespace palpable::vision
