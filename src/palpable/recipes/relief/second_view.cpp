// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/second_view.hpp"

#include "palpable/sculpt/relief/holes.hpp"
#include "palpable/vision/stereo/problem/exposure_match.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace palpable::recipes {
namespace {

/// As many as the vertices with which a page shows a surface.
constexpr int kLongestSide = 320;

std::uint16_t packed(double share) {
  constexpr double kMost = 65535.0;
  return static_cast<std::uint16_t>(std::lround(std::clamp(models::kShiftScale * (1.0 + share), 0.0, kMost)));
}

/// A picture whose exposure differs, with the levels of the other one: two eyes see one brightness.
Image exposed_as(const Image& left, Image right) {
  const auto match = vision::match_exposures(left, right, {});
  if (!match.exposure.differs) return right;
  const auto channels = static_cast<std::size_t>(right.channels);
  for (std::size_t k = 0; k < right.samples.size(); ++k)
    if (const std::size_t c = k % channels; c < match.curves.size())
      right.samples[k] = match.curves[c](right.samples[k]);
  return right;
}

}  // namespace

models::SecondView second_view(const Image& left, const Image& right, Raster<float> disparity_px) {
  sculpt::fill_unknown_heights(disparity_px);
  const int width = disparity_px.width(), height = disparity_px.height();
  const double shrink = std::min(1.0, 1.0 * kLongestSide / std::max(width, height));
  const auto side = [&](int n) { return std::max(std::min(n, 2), static_cast<int>(n * shrink)); };
  Raster<std::uint16_t> shift(side(width), side(height));
  for (int j = 0; j < shift.height(); ++j) {
    const int y0 = j * height / shift.height(), y1 = (j + 1) * height / shift.height();
    for (int i = 0; i < shift.width(); ++i) {
      const int x0 = i * width / shift.width(), x1 = (i + 1) * width / shift.width();
      double sum = 0.0;
      for (int y = y0; y < y1; ++y)
        for (int x = x0; x < x1; ++x) sum += static_cast<double>(disparity_px(x, y));
      shift(i, j) = packed(sum / ((x1 - x0) * (y1 - y0)) / width);
    }
  }
  return {rgb8(exposed_as(left, right)), std::move(shift)};
}

}  // namespace palpable::recipes
