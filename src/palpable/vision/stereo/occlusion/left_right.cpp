// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/left_right.hpp"

#include "palpable/core/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace palpable::vision {

Raster<float> agreement(const Raster<float>& disparity, const Raster<float>& other) {
  constexpr float kAgreement_px = 1.0F;
  Raster<float> out(disparity.width(), disparity.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const float d = disparity(x, y);
      if (!std::isfinite(d)) continue;
      const int there = static_cast<int>(std::floor(static_cast<float>(x) - d + 0.5F));
      if (other.contains(there, y) && std::fabs(other(there, y) - d) <= kAgreement_px) out(x, y) = 1.0F;
    }
  return out;
}

void hide_before(int first, Raster<float>& other) {
  for (int y = 0; y < other.height(); ++y)
    std::fill_n(other.row(y).begin(), std::min(first, other.width()), std::numeric_limits<float>::infinity());
}

float quantile_where(const Raster<float>& values, const Raster<float>& weight, double at) {
  std::vector<float> kept;
  for (std::size_t i = 0; i < values.count(); ++i)
    if (weight.values()[i] > 0.0F) kept.push_back(values.values()[i]);
  if (kept.empty()) return 0.0F;
  return quantile_of(kept, at);
}

}  // namespace palpable::vision
