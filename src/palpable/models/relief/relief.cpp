// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace palpable::models {
namespace {

constexpr std::size_t kMostSamples = std::size_t{64} * 1024 * 1024;

/// A cell of the grid and the position in it, 0 <= fraction < 1. From two pixels beyond the border on, all
/// control values are the border's, so the position is clamped there. The comparisons also clamp NaN.
struct Cell {
  int index;
  double fraction;
};
Cell cell_at(double place_px, int count) noexcept {
  const double last = count + 2.0;
  const double held = place_px > -3.0 ? (place_px < last ? place_px : last) : -3.0;
  const int index = static_cast<int>(held + 4.0) - 4;
  return {index, held - index};
}

}  // namespace

Result<Relief> Relief::from_samples(Raster<float> height_m, double pixel_m) {
  if (height_m.width() < 2 || height_m.height() < 2)
    return invalid_input("a relief needs at least 2 x 2 samples");
  if (height_m.count() > kMostSamples) return invalid_input("a relief may have at most 64 million samples");
  if (!(pixel_m > 0.0 && pixel_m <= 1.0))
    return invalid_input("a relief's pixel must be above 0 and at most 1 m");
  const auto values = height_m.values();
  if (!std::all_of(values.begin(), values.end(), [](float z) { return std::isfinite(z); }))
    return invalid_input("a relief's heights must all be finite");

  Relief relief;
  const auto [lowest, highest] = std::minmax_element(values.begin(), values.end());
  relief.lowest_m_ = *lowest;
  relief.highest_m_ = *highest;
  double step_x = 0.0;
  double step_y = 0.0;
  for (int y = 0; y < height_m.height(); ++y) {
    const auto row = height_m.row(y);
    const auto below = height_m.row(std::min(y + 1, height_m.height() - 1));
    for (std::size_t x = 0; x < row.size(); ++x) {
      if (x + 1 < row.size()) step_x = std::max(step_x, std::abs(double{row[x + 1]} - double{row[x]}));
      step_y = std::max(step_y, std::abs(double{below[x]} - double{row[x]}));
    }
  }
  // Each derivative of the spline is a weighted mean of differences of the control values.
  relief.steepest_slope_ = std::hypot(step_x, step_y) / pixel_m;
  relief.pixel_m_ = pixel_m;
  relief.pixels_per_m_ = 1.0 / pixel_m;
  relief.middle_x_px_ = 0.5 * (height_m.width() - 1);
  relief.middle_y_px_ = 0.5 * (height_m.height() - 1);
  relief.inside_x_px_ = height_m.width() - 2;
  relief.inside_y_px_ = height_m.height() - 2;
  relief.height_m_ = std::move(height_m);
  return relief;
}

SplinePlace Relief::border_place(double x_px, double y_px, std::array<float, 16>& copy) const noexcept {
  const Cell cx = cell_at(x_px, height_m_.width());
  const Cell cy = cell_at(y_px, height_m_.height());
  for (int y = 0; y < 4; ++y) {
    const int row = std::clamp(cy.index - 1 + y, 0, height_m_.height() - 1);
    for (int x = 0; x < 4; ++x)
      copy[static_cast<std::size_t>(4 * y + x)] =
          height_m_(std::clamp(cx.index - 1 + x, 0, height_m_.width() - 1), row);
  }
  return {copy.data(), 4, Pair{cx.fraction, cy.fraction}};
}

std::size_t Relief::memory_bytes() const { return sizeof(Relief) + height_m_.count() * sizeof(float); }

}  // namespace palpable::models
