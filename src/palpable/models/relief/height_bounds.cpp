// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/height_bounds.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::models {
namespace {

/// The block that contains a position; outside, the nearest border block, since the surface continues it.
int block_at(double place_px, double per_px, int count) noexcept {
  const double block = place_px * per_px;
  return block > 0.0 ? (block < count - 1 ? static_cast<int>(block) : count - 1) : 0;
}

SurfaceBounds larger(SurfaceBounds a, SurfaceBounds b) noexcept {
  return {std::max(a.highest, b.highest), std::max(a.steepest, b.steepest)};
}

/// Bounds of the surface between the control values x0 to x1 and y0 to y1. Its slope along an axis is a mean
/// of their differences.
SurfaceBounds bounds_of(const Raster<float>& values, int x0, int x1, int y0, int y1) {
  float highest = values(x0, y0);
  float across = 0.0F;
  float down = 0.0F;
  for (int y = y0; y <= y1; ++y)
    for (int x = x0; x <= x1; ++x) {
      highest = std::max(highest, values(x, y));
      if (x < x1) across = std::max(across, std::abs(values(x + 1, y) - values(x, y)));
      if (y < y1) down = std::max(down, std::abs(values(x, y + 1) - values(x, y)));
    }
  return {highest, std::hypot(across, down)};
}

}  // namespace

HeightBounds::HeightBounds(const Raster<float>& control_values) {
  const int w = control_values.width();
  const int h = control_values.height();
  const Level finest{0, (w + kBlock_px - 1) / kBlock_px, (h + kBlock_px - 1) / kBlock_px};
  blocks_.reserve(static_cast<std::size_t>(finest.width) * static_cast<std::size_t>(finest.height) * 4 / 3 +
                  8);
  for (int j = 0; j < finest.height; ++j)
    for (int i = 0; i < finest.width; ++i) {
      // The cells of a block depend on one control value before it and two after it.
      const int x = kBlock_px * i;
      const int y = kBlock_px * j;
      blocks_.push_back(bounds_of(control_values, std::max(0, x - 1), std::min(w - 1, x + kBlock_px + 1),
                                  std::max(0, y - 1), std::min(h - 1, y + kBlock_px + 1)));
    }
  add_coarser_levels(finest);
}

void HeightBounds::add_coarser_levels(Level level) {
  levels_.push_back(level);
  while (level.width > 1 || level.height > 1) {
    const Level finer = level;
    level = {blocks_.size(), (finer.width + 1) / 2, (finer.height + 1) / 2};
    const auto at = [&](int x, int y) {
      return blocks_[finer.begin +
                     static_cast<std::size_t>(std::min(y, finer.height - 1)) *
                         static_cast<std::size_t>(finer.width) +
                     static_cast<std::size_t>(std::min(x, finer.width - 1))];
    };
    for (int j = 0; j < level.height; ++j)
      for (int i = 0; i < level.width; ++i)
        blocks_.push_back(larger(larger(at(2 * i, 2 * j), at(2 * i + 1, 2 * j)),
                                 larger(at(2 * i, 2 * j + 1), at(2 * i + 1, 2 * j + 1))));
    levels_.push_back(level);
  }
}

SurfaceBounds HeightBounds::over(double x0_px, double y0_px, double x1_px, double y1_px) const noexcept {
  // The finest level at which the rectangle meets at most four blocks.
  const double side_px = std::max(x1_px - x0_px, y1_px - y0_px);
  double per_px = 1.0 / kBlock_px;
  std::size_t k = 0;
  while (side_px * per_px > 1.0 && k + 1 < levels_.size()) {
    per_px *= 0.5;
    ++k;
  }
  const Level& level = levels_[k];
  const int i0 = block_at(x0_px, per_px, level.width);
  const int i1 = block_at(x1_px, per_px, level.width);
  const int j0 = block_at(y0_px, per_px, level.height);
  const int j1 = block_at(y1_px, per_px, level.height);
  const SurfaceBounds* const upper =
      blocks_.data() + level.begin + static_cast<std::size_t>(j0) * static_cast<std::size_t>(level.width);
  const SurfaceBounds* const lower =
      blocks_.data() + level.begin + static_cast<std::size_t>(j1) * static_cast<std::size_t>(level.width);
  return larger(larger(upper[i0], upper[i1]), larger(lower[i0], lower[i1]));
}

}  // namespace palpable::models
