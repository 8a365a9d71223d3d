// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/finer_cells.hpp"

#include "palpable/core/check.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace palpable::models {
namespace {

/// Of the surface: its height is a mean of control values, its slope along an axis one of their differences.
FinerCells::CellBounds bounds_of_cell(const FinerCell& cell) {
  const auto side = static_cast<std::size_t>(cell.parts) + 3;
  float highest = cell.values_m.front();
  float across = 0.0F;
  float down = 0.0F;
  for (std::size_t k = 0; k < cell.values_m.size(); ++k) {
    const float z = cell.values_m[k];
    highest = std::max(highest, z);
    if ((k + 1) % side != 0) across = std::max(across, std::abs(cell.values_m[k + 1] - z));
    if (k + side < cell.values_m.size()) down = std::max(down, std::abs(cell.values_m[k + side] - z));
  }
  return {cell.x, cell.y, highest, std::hypot(across, down) * static_cast<float>(cell.parts), cell.lowered_m};
}

}  // namespace

FinerCells::FinerCells(int width, int height, const std::vector<FinerCell>& cells)
    : blocks_((static_cast<std::uint32_t>(width) + kBlock - 1) / kBlock),
      pages_(std::size_t{blocks_} * ((static_cast<std::uint32_t>(height) + kBlock - 1) / kBlock)),
      // No page and no cell begins at 0, which means none.
      entries_(kBlock * kBlock),
      values_(kUnit) {
  for (const FinerCell& cell : cells) {
    const auto x = static_cast<std::uint32_t>(cell.x);
    const auto y = static_cast<std::uint32_t>(cell.y);
    const auto parts = static_cast<std::uint32_t>(cell.parts);
    PALPABLE_CHECK(cell.x >= 1 && cell.x < width - 2 && cell.y >= 1 && cell.y < height - 2);
    PALPABLE_CHECK(std::has_single_bit(parts) && parts > 1 && parts < (1U << kLevels) &&
                   cell.values_m.size() == std::size_t{parts + 3} * (parts + 3));
    std::uint32_t& page = pages_[(y / kBlock) * blocks_ + x / kBlock];
    if (page == 0) {
      page = static_cast<std::uint32_t>(entries_.size());
      entries_.resize(entries_.size() + kBlock * kBlock);
    }
    const std::size_t first = values_.size() / kUnit;
    PALPABLE_CHECK(first < (std::size_t{1} << 32U) / kLevels);
    entries_[page + (y % kBlock) * kBlock + x % kBlock] =
        static_cast<std::uint32_t>(first) * kLevels + static_cast<std::uint32_t>(std::countr_zero(parts));
    values_.insert(values_.end(), cell.values_m.begin(), cell.values_m.end());
    bounds_.push_back(bounds_of_cell(cell));
    steepest_per_pixel_ = std::max(steepest_per_pixel_, double{bounds_.back().steepest});
    values_.resize((values_.size() + kUnit - 1) / kUnit * kUnit);
  }
}

std::size_t FinerCells::memory_bytes() const noexcept {
  std::size_t bytes = sizeof(*this) + bounds_.size() * sizeof(CellBounds);
  each_array([&](const void*, std::size_t size) { bytes += size; });
  return bytes;
}

}  // namespace palpable::models
