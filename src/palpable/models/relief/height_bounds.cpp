// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/height_bounds.hpp"

#include <algorithm>

namespace palpable::models {
namespace {

/// The block that holds a place; outside, the border's: there the surface continues it.
int block_at(double place_px, double per_px, int count) noexcept {
  const double block = place_px * per_px;
  return block > 0.0 ? (block < count - 1 ? static_cast<int>(block) : count - 1) : 0;
}

}  // namespace

HeightBounds::HeightBounds(const Raster<float>& control_values) {
  const int w = control_values.width();
  const int h = control_values.height();
  Level level{0, (w + kBlock_px - 1) / kBlock_px, (h + kBlock_px - 1) / kBlock_px};
  bounds_.reserve(static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height) * 4 / 3 + 8);
  for (int j = 0; j < level.height; ++j)
    for (int i = 0; i < level.width; ++i) {
      // The cells of a block reach for one control value before it and two behind.
      const int x0 = std::max(0, kBlock_px * i - 1);
      const int x1 = std::min(w - 1, kBlock_px * i + kBlock_px + 1);
      const int y0 = std::max(0, kBlock_px * j - 1);
      const int y1 = std::min(h - 1, kBlock_px * j + kBlock_px + 1);
      float highest = control_values(x0, y0);
      for (int y = y0; y <= y1; ++y)
        for (int x = x0; x <= x1; ++x) highest = std::max(highest, control_values(x, y));
      bounds_.push_back(highest);
    }
  levels_.push_back(level);
  while (level.width > 1 || level.height > 1) {
    const Level finer = level;
    level = {bounds_.size(), (finer.width + 1) / 2, (finer.height + 1) / 2};
    for (int j = 0; j < level.height; ++j)
      for (int i = 0; i < level.width; ++i) {
        const auto at = [&](int x, int y) {
          return bounds_[finer.begin +
                         static_cast<std::size_t>(std::min(y, finer.height - 1)) *
                             static_cast<std::size_t>(finer.width) +
                         static_cast<std::size_t>(std::min(x, finer.width - 1))];
        };
        bounds_.push_back(std::max(std::max(at(2 * i, 2 * j), at(2 * i + 1, 2 * j)),
                                   std::max(at(2 * i, 2 * j + 1), at(2 * i + 1, 2 * j + 1))));
      }
    levels_.push_back(level);
  }
}

float HeightBounds::highest_in(double x0_px, double y0_px, double x1_px, double y1_px) const noexcept {
  // The finest level of which the rectangle meets four blocks at most.
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
  const float* const upper =
      bounds_.data() + level.begin + static_cast<std::size_t>(j0) * static_cast<std::size_t>(level.width);
  const float* const lower =
      bounds_.data() + level.begin + static_cast<std::size_t>(j1) * static_cast<std::size_t>(level.width);
  return std::max(std::max(upper[i0], upper[i1]), std::max(lower[i0], lower[i1]));
}

}  // namespace palpable::models
