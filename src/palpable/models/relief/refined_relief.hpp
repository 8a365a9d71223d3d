// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/height_bounds.hpp"
#include "palpable/models/relief/relief.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace palpable::models {

/// Control values of a finer spline in some cells of a relief. A cell is the square between the samples (x,
/// y) and (x + 1, y + 1).
struct ReliefCells {
  /// Fine pixels per pixel of the relief, at least 4.
  int per_pixel = 4;
  /// The refined cells, row by row. Only those with 1 <= x < width - 2 and 1 <= y < height - 2 may be.
  struct Cell {
    int x = 0;
    int y = 0;
  };
  std::vector<Cell> cells;
  /// For each of them (per_pixel + 3)^2 values, row by row, one fine pixel beyond the cell on each side and
  /// two at its end. Where cells meet, their values must agree; one fine pixel around a cell that is not
  /// refined, they must be those of the relief's own spline (subdivided_values()).
  std::vector<float> values;
};

/// The control values of the same spline in one cell, at `per_pixel` times its resolution (knot insertion):
/// written to (per_pixel + 3)^2 values as in ReliefCells.
void subdivide_cell(const Relief& relief, ReliefCells::Cell cell, int per_pixel, float* values);

/// A relief with a finer spline in some of its cells, where its own pixels are too coarse, as in creases.
/// Height, slope and curvature are continuous, also between cells of both kinds. A query costs one look-up
/// more than a relief's. Models BoundedHeightField. Immutable; any thread.
class RefinedRelief {
 public:
  RefinedRelief(const std::shared_ptr<const Relief>& relief, ReliefCells cells);

  HeightSample sample(double x_m, double y_m) const noexcept;
  CurvedSample curved_sample(double x_m, double y_m) const noexcept;
  /// Prefetches the data for a later query, as Relief does. Tick path.
  void prefetch(double x_m, double y_m) const noexcept;
  double steepest_slope() const noexcept { return steepest_slope_; }
  /// The relief's pixel, not that of its refined cells.
  double pixel_m() const noexcept { return bounded_.pixel_m(); }
  SurfaceBounds bounds_over(double x0_m, double y0_m, double x1_m, double y1_m) const noexcept {
    return bounded_.bounds_over(x0_m, y0_m, x1_m, y1_m);
  }

  /// The surface without its refined cells.
  const BoundedRelief& unrefined() const noexcept { return bounded_; }
  const Relief& relief() const noexcept { return bounded_.relief(); }
  const ReliefCells& cells() const noexcept { return cells_; }
  std::size_t memory_bytes() const;

 private:
  bool place_in_cell(double x_m, double y_m, SplinePlace& place) const noexcept;

  ReliefCells cells_;
  BoundedRelief bounded_;
  /// 64 cells of the relief, row by row: which of them are refined, and how many were before them. It is
  /// small, so that it stays in the cache.
  struct CellBits {
    std::uint64_t refined = 0;
    std::uint32_t before = 0;
  };
  std::vector<CellBits> bits_;
  /// Only cells left of and above these can be refined.
  int width_ = 0;
  int height_ = 0;
  double steepest_slope_ = 0.0;
  double middle_x_px_ = 0.0;
  double middle_y_px_ = 0.0;
  double pixels_per_m_ = 0.0;
  double fine_per_m_ = 0.0;
};

/// std::popcount() is a call on processors without such an instruction, which the build does not require.
inline std::size_t set_bits(std::uint64_t v) noexcept {
  v -= (v >> 1U) & 0x5555555555555555U;
  v = (v & 0x3333333333333333U) + ((v >> 2U) & 0x3333333333333333U);
  v = (v + (v >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
  return (v * 0x0101010101010101U) >> 56U;
}

inline bool RefinedRelief::place_in_cell(double x_m, double y_m, SplinePlace& place) const noexcept {
  const double x_px = middle_x_px_ + x_m * pixels_per_m_;
  const double y_px = middle_y_px_ - y_m * pixels_per_m_;
  // Written so that NaN goes to the relief, which handles it. Border cells are not refined.
  if (!(x_px >= 1.0 && x_px < width_ && y_px >= 1.0 && y_px < height_)) return false;
  const int x = static_cast<int>(x_px);
  const int y = static_cast<int>(y_px);
  const std::size_t cell =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  const CellBits& bits = bits_[cell / 64];
  const std::uint64_t here = std::uint64_t{1} << (cell % 64);
  if ((bits.refined & here) == 0) return false;
  const std::size_t k = bits.before + set_bits(bits.refined & (here - 1));
  const auto n = static_cast<std::size_t>(cells_.per_pixel);
  const double right = (x_px - x) * cells_.per_pixel;
  const double down = (y_px - y) * cells_.per_pixel;
  const int i = static_cast<int>(right);
  const int j = static_cast<int>(down);
  const std::size_t stride = n + 3;
  const float* const tile = cells_.values.data() + k * stride * stride;
  place = {tile + static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i), stride, right - i,
           down - j};
  return true;
}

// Forced inline: g++ removes calls of a function that only prefetches, since it has no visible effect.
[[gnu::always_inline]] inline void RefinedRelief::prefetch(double x_m, double y_m) const noexcept {
  SplinePlace place;
  if (!place_in_cell(x_m, y_m, place)) return bounded_.prefetch(x_m, y_m);
  for (std::size_t row = 0; row < 4; ++row) {
    __builtin_prefetch(place.first + row * place.stride);
    __builtin_prefetch(place.first + row * place.stride + 3);
  }
}

inline HeightSample RefinedRelief::sample(double x_m, double y_m) const noexcept {
  SplinePlace place;
  if (!place_in_cell(x_m, y_m, place)) return bounded_.sample(x_m, y_m);
  const SplineValue value = SplineBlock(place).evaluate();
  return {value.z, value.right * fine_per_m_, -value.down * fine_per_m_};
}

inline CurvedSample RefinedRelief::curved_sample(double x_m, double y_m) const noexcept {
  SplinePlace place;
  if (!place_in_cell(x_m, y_m, place)) return bounded_.curved_sample(x_m, y_m);
  const SplineValue value = SplineBlock(place).evaluate_with_curvature();
  const double s = fine_per_m_;
  return {value.z,
          value.right * s,
          -value.down * s,
          value.right_right * (s * s),
          -value.right_down * (s * s),
          value.down_down * (s * s)};
}

}  // namespace palpable::models
