// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/spline_block.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace palpable::models {

/// A cell of a relief, the square right of and below sample (x, y), as a cubic B-spline with more control
/// values: `parts` x `parts` smaller cells, with the (parts + 3)^2 control values that these depend on, row
/// by row.
struct FinerCell {
  int x = 0;
  int y = 0;
  int parts = 1;
  std::vector<float> values_m;
  /// An upper bound of how far it is below the relief's own spline.
  float lowered_m = 0.0F;
};

/// The cells of a relief where its spline is too coarse, each replaced by a finer spline (hierarchical
/// B-splines: Forsey & Bartels 1988; Kraft 1997). A coarser spline is also a finer one (knot insertion), so
/// each cell contains the whole surface, and an evaluation reads one block of 4 x 4 values whatever the
/// number of levels. Immutable; any thread.
class FinerCells {
 public:
  /// A relief of width x height samples; cells of 1 <= x < width - 2, 1 <= y < height - 2, each once.
  /// `parts`: a power of two from 2 to 128.
  FinerCells(int width, int height, const std::vector<FinerCell>& cells);

  /// The place in a finer cell of the position (x_px, y_px), 1 <= x_px < width - 2, 1 <= y_px < height - 2,
  /// and its parts; parts is 0 if no finer cell is there. Tick path.
  struct Found {
    SplinePlace place;
    int parts = 0;
  };
  Found find(double x_px, double y_px) const noexcept {
    const auto x = static_cast<std::uint32_t>(x_px);
    const auto y = static_cast<std::uint32_t>(y_px);
    const std::uint32_t page = pages_[(y / kBlock) * blocks_ + x / kBlock];
    if (page == 0) return {};
    const std::uint32_t entry = entries_[page + (y % kBlock) * kBlock + x % kBlock];
    if (entry == 0) return {};
    const std::uint32_t level = entry % kLevels;
    const int parts = 1 << level;
    const double right = (x_px - x) * parts;
    const double down = (y_px - y) * parts;
    const int i = static_cast<int>(right);
    const int j = static_cast<int>(down);
    const std::size_t stride = static_cast<std::size_t>(parts) + 3;
    return {{values_.data() + std::size_t{entry / kLevels} * kUnit + static_cast<std::size_t>(j) * stride +
                 static_cast<std::size_t>(i),
             stride, right - i, down - j},
            parts};
  }

  /// An upper bound of the slope in all finer cells, in height per pixel.
  double steepest_per_pixel() const noexcept { return steepest_per_pixel_; }

  /// Upper bounds in each finer cell: of the height, of the slope per pixel, and of how far it is below the
  /// relief's own spline.
  struct CellBounds {
    int x = 0;
    int y = 0;
    float highest = 0.0F;
    float steepest = 0.0F;
    float lowered_m = 0.0F;
  };
  const std::vector<CellBounds>& bounds() const noexcept { return bounds_; }

  std::size_t memory_bytes() const noexcept;
  /// Calls visit(data, bytes) with each of its arrays.
  template <class Visit>
  void each_array(const Visit& visit) const {
    visit(pages_.data(), pages_.size() * sizeof(std::uint32_t));
    visit(entries_.data(), entries_.size() * sizeof(std::uint32_t));
    visit(values_.data(), values_.size() * sizeof(float));
  }

 private:
  /// Cells along each side of a block, which has a page of entries if one of its cells is finer.
  static constexpr std::uint32_t kBlock = 8;
  static constexpr std::uint32_t kLevels = 8;
  /// Entries count values in units of a vector.
  static constexpr std::size_t kUnit = 4;

  std::uint32_t blocks_ = 0;
  /// For each block the first entry of its page; 0 = none.
  std::vector<std::uint32_t> pages_;
  /// For each cell where its values begin, and the logarithm of its parts; 0 = none.
  std::vector<std::uint32_t> entries_;
  std::vector<float> values_;
  double steepest_per_pixel_ = 0.0;
  std::vector<CellBounds> bounds_;
};

}  // namespace palpable::models
