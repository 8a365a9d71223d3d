// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/left_right_check.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace palpable::vision {

Raster<float> left_right_check(const Raster<float>& disparity, const Raster<float>& other) {
  Raster<float> out(disparity.width(), disparity.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const float d = disparity(x, y);
      if (!std::isfinite(d)) continue;
      const int there = static_cast<int>(std::floor(static_cast<float>(x) - d + 0.5F));
      if (other.contains(there, y) && std::fabs(other(there, y) - d) <= kLeftRightTolerance_px)
        out(x, y) = 1.0F;
    }
  return out;
}

void left_right_check_row(std::span<const float> left_px, std::span<const float> right_px, int right_first,
                          std::span<std::uint8_t> confirmed) {
  const auto width = static_cast<std::ptrdiff_t>(left_px.size());
  for (std::ptrdiff_t x = 0; x < width; ++x) {
    const auto i = static_cast<std::size_t>(x);
    const std::ptrdiff_t to = x - std::lround(left_px[i]);
    confirmed[i] = to >= right_first && to < width &&
                   std::abs(right_px[static_cast<std::size_t>(to)] - left_px[i]) <= kLeftRightTolerance_px;
  }
}

void mask_columns_before(int first, Raster<float>& other) {
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
