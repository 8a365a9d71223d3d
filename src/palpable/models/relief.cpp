// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <utility>

namespace palpable::models {
namespace {

// The compiler's own vector types: SSE2 operations on any x86-64, without a dispatch in the tick.
using Double2 = double __attribute__((vector_size(16)));
using Float2 = float __attribute__((vector_size(8)));

/// Four values, or the four weights that go with them.
struct Double4 {
  Double2 first;
  Double2 last;
  double operator[](int k) const noexcept { return k < 2 ? first[k] : last[k - 2]; }
};
inline Double4 operator*(const Double4& a, double s) noexcept { return {a.first * s, a.last * s}; }
inline Double4 operator+(const Double4& a, const Double4& b) noexcept {
  return {a.first + b.first, a.last + b.last};
}

constexpr std::size_t kMostSamples = std::size_t{64} * 1024 * 1024;

/// A cell of the grid and the place in it, 0 <= fraction < 1.
struct Cell {
  int index;
  double fraction;
};

inline Cell cell_at(double place_px, int count) noexcept {
  if (place_px >= 1.0 && place_px < count - 2.0) {
    const int index = static_cast<int>(place_px);
    return {index, place_px - index};
  }
  // Two pixels beyond the border all control values are the border's own, so the place may be held there. The
  // comparisons are written so that NaN is held too.
  const double last = count + 2.0;
  const double held = place_px > -3.0 ? (place_px < last ? place_px : last) : -3.0;
  const int index = static_cast<int>(held + 4.0) - 4;
  return {index, held - index};
}

// Uniform cubic B-spline weights of the four control values round a cell, and their first and second
// derivatives: as polynomials in Estrin's order, whose chain of operations is short. A law waits for each
// look at the surface.
inline Double4 weights(double t) noexcept {
  const double t2 = t * t;
  constexpr double k = 1.0 / 6.0;
  return (Double4{{k, 4 * k}, {k, 0.0}} + Double4{{-3 * k, 0.0}, {3 * k, 0.0}} * t) +
         (Double4{{3 * k, -6 * k}, {3 * k, 0.0}} + Double4{{-k, 3 * k}, {-3 * k, k}} * t) * t2;
}
inline Double4 slope_weights(double t) noexcept {
  return Double4{{-0.5, 0.0}, {0.5, 0.0}} +
         (Double4{{1.0, -2.0}, {1.0, 0.0}} + Double4{{-0.5, 1.5}, {-1.5, 0.5}} * t) * t;
}
inline Double4 curvature_weights(double t) noexcept {
  return Double4{{1.0, -2.0}, {1.0, 0.0}} + Double4{{-1.0, 3.0}, {-3.0, 1.0}} * t;
}

double sum_of_products(const Double4& a, const Double4& b) noexcept {
  const Double2 p = a.first * b.first + a.last * b.last;
  return p[0] + p[1];
}

/// Where to read a 4 x 4 block of control values: inside the samples, or in a copy made at the border.
struct Block {
  const float* first;
  std::size_t stride;
};

// Rare, and kept out of the way of the common case.
[[gnu::noinline]] Block border_block(const Raster<float>& samples, int i, int j,
                                     std::array<float, 16>& copy) noexcept {
  for (int y = 0; y < 4; ++y) {
    const int row = std::clamp(j - 1 + y, 0, samples.height() - 1);
    for (int x = 0; x < 4; ++x)
      copy[static_cast<std::size_t>(4 * y + x)] = samples(std::clamp(i - 1 + x, 0, samples.width() - 1), row);
  }
  return {copy.data(), 4};
}

inline Block block_at(const Raster<float>& samples, int i, int j, std::array<float, 16>& copy) noexcept {
  const auto stride = static_cast<std::size_t>(samples.width());
  if (i >= 1 && j >= 1 && i + 2 < samples.width() && j + 2 < samples.height())
    return {samples.data() + static_cast<std::size_t>(j - 1) * stride + static_cast<std::size_t>(i - 1),
            stride};
  return border_block(samples, i, j, copy);
}

inline std::array<Double4, 4> rows_of(const Block& block) noexcept {
  std::array<Double4, 4> rows;
  for (std::size_t k = 0; k < 4; ++k) {
    Float2 first;
    Float2 last;
    std::memcpy(&first, block.first + k * block.stride, sizeof first);
    std::memcpy(&last, block.first + k * block.stride + 2, sizeof last);
    rows[k] = {__builtin_convertvector(first, Double2), __builtin_convertvector(last, Double2)};
  }
  return rows;
}

inline Double4 combine(const std::array<Double4, 4>& rows, const Double4& w) noexcept {
  return (rows[0] * w[0] + rows[1] * w[1]) + (rows[2] * w[2] + rows[3] * w[3]);
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
  // Each derivative of the spline is a weighted mean of the control values' differences.
  relief.steepest_slope_ = std::hypot(step_x, step_y) / pixel_m;
  relief.pixel_m_ = pixel_m;
  relief.pixels_per_m_ = 1.0 / pixel_m;
  relief.height_m_ = std::move(height_m);
  return relief;
}

HeightSample Relief::sample(double x_m, double y_m) const noexcept {
  const Cell cx = cell_at(x_m * pixels_per_m_ + 0.5 * (height_m_.width() - 1), height_m_.width());
  const Cell cy = cell_at(0.5 * (height_m_.height() - 1) - y_m * pixels_per_m_, height_m_.height());
  std::array<float, 16> copy;
  const auto rows = rows_of(block_at(height_m_, cx.index, cy.index, copy));
  const Double4 values = combine(rows, weights(cy.fraction));
  const Double4 slopes = combine(rows, slope_weights(cy.fraction));
  const Double4 wx = weights(cx.fraction);
  return {sum_of_products(values, wx), sum_of_products(values, slope_weights(cx.fraction)) * pixels_per_m_,
          -sum_of_products(slopes, wx) * pixels_per_m_};
}

CurvedSample Relief::curved_sample(double x_m, double y_m) const noexcept {
  const Cell cx = cell_at(x_m * pixels_per_m_ + 0.5 * (height_m_.width() - 1), height_m_.width());
  const Cell cy = cell_at(0.5 * (height_m_.height() - 1) - y_m * pixels_per_m_, height_m_.height());
  std::array<float, 16> copy;
  const auto rows = rows_of(block_at(height_m_, cx.index, cy.index, copy));
  const Double4 values = combine(rows, weights(cy.fraction));
  const Double4 slopes = combine(rows, slope_weights(cy.fraction));
  const Double4 curvatures = combine(rows, curvature_weights(cy.fraction));
  const Double4 wx = weights(cx.fraction);
  const Double4 dx = slope_weights(cx.fraction);
  const double s = pixels_per_m_;
  return {sum_of_products(values, wx),
          sum_of_products(values, dx) * s,
          -sum_of_products(slopes, wx) * s,
          sum_of_products(values, curvature_weights(cx.fraction)) * (s * s),
          -sum_of_products(slopes, dx) * (s * s),
          sum_of_products(curvatures, wx) * (s * s)};
}

std::size_t Relief::memory_bytes() const { return sizeof(Relief) + height_m_.count() * sizeof(float); }

}  // namespace palpable::models
