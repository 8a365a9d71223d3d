// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstring>

namespace palpable::models {

/// A position in the grid of control values of a uniform cubic B-spline: the 4 x 4 values around its cell
/// (`first` is the first of the first row), and the fraction within the cell to the right and down, 0 <=
/// fraction < 1.
struct SplinePlace {
  const float* first = nullptr;
  std::size_t stride = 0;
  double right = 0.0;
  double down = 0.0;
};

/// Height, slopes and second derivatives in the grid's own axes and units of its pixel.
struct SplineValue {
  double z = 0.0;
  double right = 0.0;
  double down = 0.0;
  double right_right = 0.0;
  double right_down = 0.0;
  double down_down = 0.0;
};

/// The arithmetic of one surface evaluation, optimised for latency, since a law's next evaluation depends on
/// the previous one. It uses the compiler's vector type: SSE operations on any x86-64, without a dispatch in
/// the tick. Single precision suffices because only differences within the block are summed: the rounding
/// error is 1e-7 of these differences, not of the heights.
class SplineBlock {
 public:
  explicit SplineBlock(const SplinePlace& place) noexcept
      : base_(place.first[place.stride + 1]),
        right_(splat(static_cast<float>(place.right))),
        down_(splat(static_cast<float>(place.down))) {
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      std::memcpy(&rows_[k], place.first + k * place.stride, sizeof(Float4));
      rows_[k] -= splat(base_);
    }
  }

  /// Height and slopes; the second derivatives are 0.
  SplineValue evaluate() const noexcept {
    const Float4 values = combined(weights(down_));
    const Float4 across = weights(right_);
    const Float4 s = sums(values * across, values * slope_weights(right_),
                          combined(slope_weights(down_)) * across, Float4{});
    return {double{base_} + s[0], s[1], s[2], 0.0, 0.0, 0.0};
  }

  SplineValue evaluate_with_curvature() const noexcept {
    const Float4 values = combined(weights(down_));
    const Float4 slopes = combined(slope_weights(down_));
    const Float4 curvatures = combined(curvature_weights(down_));
    const Float4 across = weights(right_);
    const Float4 slope = slope_weights(right_);
    const Float4 s = sums(values * across, values * slope, slopes * across, slopes * slope);
    const Float4 c = sums(values * curvature_weights(right_), curvatures * across, Float4{}, Float4{});
    return {double{base_} + s[0], s[1], s[2], c[0], s[3], c[1]};
  }

 private:
  using Float4 = float __attribute__((vector_size(16)));
  using Int4 = int __attribute__((vector_size(16)));

  static Float4 splat(float v) noexcept { return Float4{v, v, v, v}; }
  template <int k>
  static Float4 spread(Float4 v) noexcept {
    return __builtin_shufflevector(v, v, k, k, k, k);
  }

  // Weights of the four control values in a row, and their first and second derivatives: as polynomials in
  // Estrin's order.
  static Float4 weights(Float4 t) noexcept {
    constexpr float k = 1.0F / 6.0F;
    return (Float4{k, 4 * k, k, 0.0F} + Float4{-3 * k, 0.0F, 3 * k, 0.0F} * t) +
           (Float4{3 * k, -6 * k, 3 * k, 0.0F} + Float4{-k, 3 * k, -3 * k, k} * t) * (t * t);
  }
  static Float4 slope_weights(Float4 t) noexcept {
    return Float4{-0.5F, 0.0F, 0.5F, 0.0F} +
           (Float4{1.0F, -2.0F, 1.0F, 0.0F} + Float4{-0.5F, 1.5F, -1.5F, 0.5F} * t) * t;
  }
  static Float4 curvature_weights(Float4 t) noexcept {
    return Float4{1.0F, -2.0F, 1.0F, 0.0F} + Float4{-1.0F, 3.0F, -3.0F, 1.0F} * t;
  }

  Float4 combined(Float4 w) const noexcept {
    return (rows_[0] * spread<0>(w) + rows_[1] * spread<1>(w)) +
           (rows_[2] * spread<2>(w) + rows_[3] * spread<3>(w));
  }

  /// The sums of four vectors' lanes, as one vector.
  static Float4 sums(Float4 a, Float4 b, Float4 c, Float4 d) noexcept {
    const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Float4 cd = __builtin_shufflevector(c, d, 0, 4, 1, 5) + __builtin_shufflevector(c, d, 2, 6, 3, 7);
    return __builtin_shufflevector(ab, cd, 0, 1, 4, 5) + __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
  }

  std::array<Float4, 4> rows_;
  float base_;
  Float4 right_;
  Float4 down_;
};

}  // namespace palpable::models
