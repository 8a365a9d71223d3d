// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace palpable::models {

/// Two components at once, as the compiler's vector type.
using Pair = double __attribute__((vector_size(16)));

/// A position in the grid of control values of a uniform cubic B-spline: the 4 x 4 values around its cell
/// (`first` is the first of the first row), and the fractions within the cell to the right and down, 0 <=
/// fraction < 1.
struct SplinePlace {
  const float* first = nullptr;
  std::size_t stride = 0;
  Pair fraction{};
};

/// Height and slopes in the grid's own axes (to the right, down) and units of its pixel.
struct SplineValue {
  double z = 0.0;
  double right = 0.0;
  double down = 0.0;
};

/// The same with the second derivatives: twice to the right, twice down; and once each.
struct CurvedSplineValue {
  double z = 0.0;
  Pair slope{};
  Pair bend{};
  double twist = 0.0;
};

/// Bounds of a straight path's height above a surface within one cell, metres, and a lower bound of it at the
/// path's end.
struct PathBounds {
  float lowest;
  float highest;
  float last;
};

/// The arithmetic of one surface evaluation, optimised for latency, since a law's next evaluation depends on
/// the previous one. It uses the compiler's vector type: SSE operations on any x86-64, without a dispatch in
/// the tick. Single precision suffices because only differences within the block are summed: the rounding
/// error is 1e-7 of these differences, not of the heights.
class SplineBlock {
 public:
  explicit SplineBlock(const SplinePlace& place) noexcept : base_(place.first[place.stride + 1]) {
    const auto fraction = __builtin_convertvector(place.fraction, Float2);
    right_ = splat(fraction[0]);
    down_ = splat(fraction[1]);
    for (std::size_t k = 0; k < rows_.size(); ++k)
      std::memcpy(&rows_[k], place.first + k * place.stride, sizeof(Float4));
  }

  SplineValue evaluate() const noexcept {
    const Columns columns = columns_at_fraction();
    const Float4 across = weights(right_);
    const Float4 s =
        sums(columns.slope * across, columns.value * slope_weights(right_), columns.value * across, Float4{});
    return {double{base_} + double{s[2]}, s[1], s[0]};
  }

  /// The height of a straight path above the surface, from the position to another one of the same cell (its
  /// fractions; both may be beyond the border by rounding): a polynomial of degree 6, by its Bernstein
  /// coefficients, the last one twice. The path begins at `from_z` and rises by `rise`. By blossoming
  /// (Ramshaw 1989): first the bicubic patch over the rectangle of which the path is the diagonal, then the
  /// diagonal.
  std::array<float, 8> path_above(double right, double down, double from_z, double rise) const noexcept {
    constexpr Float4 kThrees{1.0F, 3.0F, 3.0F, 1.0F};
    const std::array<Float4, 4> across = bezier_weights(right_, splat(static_cast<float>(right)));
    const std::array<Float4, 4> downwards = bezier_weights(down_, splat(static_cast<float>(down)));
    const std::array<Float4, 4> rows = rows_above_base();
    const Float4 row0 = kThrees * bezier_row<0>(rows, downwards, across);
    const Float4 row1 = 3.0F * kThrees * bezier_row<1>(rows, downwards, across);
    const Float4 row2 = 3.0F * kThrees * bezier_row<2>(rows, downwards, across);
    const Float4 row3 = kThrees * bezier_row<3>(rows, downwards, across);
    // The product of the Bernstein polynomials i and j of degree 3 is a multiple of number i + j of degree 6.
    const Float4 zero{};
    const Float4 low =
        (row0 + __builtin_shufflevector(row1, zero, 4, 0, 1, 2)) +
        (__builtin_shufflevector(row2, zero, 4, 4, 0, 1) + __builtin_shufflevector(row3, zero, 4, 4, 4, 0));
    const Float4 high =
        __builtin_shufflevector(row1, zero, 3, 4, 4, 4) +
        (__builtin_shufflevector(row2, zero, 2, 3, 4, 4) + __builtin_shufflevector(row3, zero, 1, 2, 3, 3));
    const Float4 from = splat(static_cast<float>(from_z - double{base_}));
    const auto step = static_cast<float>(rise / 6.0);
    const std::array<Float4, 2> above{
        from + Float4{0.0F, 1.0F, 2.0F, 3.0F} * step -
            low * Float4{1.0F, 1.0F / 6.0F, 1.0F / 15.0F, 1.0F / 20.0F},
        from + Float4{4.0F, 5.0F, 6.0F, 6.0F} * step - high * Float4{1.0F / 15.0F, 1.0F / 6.0F, 1.0F, 1.0F}};
    std::array<float, 8> coefficients;
    std::memcpy(coefficients.data(), above.data(), sizeof(coefficients));
    return coefficients;
  }

  /// Bounds of the same height, at a fraction of the cost: the surface less a plane is the spline of the
  /// control values less the plane, and lies between their Bezier points' extremes; those across are bounded
  /// by the extremes of each column.
  PathBounds path_bounds(double right, double down, double from_z, double rise) const noexcept {
    const std::array<Float4, 4> rows = rows_above_base();
    const float tilt_right = 0.5F * ((rows_[1][2] - rows_[1][1]) + (rows_[2][2] - rows_[2][1]));
    const float tilt_down = 0.5F * ((rows_[2][1] - rows_[1][1]) + (rows_[2][2] - rows_[1][2]));
    const Float4 plane = splat(tilt_right) * Float4{-1.0F, 0.0F, 1.0F, 2.0F};
    const Float4 tilt = splat(tilt_down);
    const Float4 rest0 = rows[0] - (plane - tilt);
    const Float4 rest1 = rows[1] - plane;
    const Float4 rest2 = rows[2] - (plane + tilt);
    const Float4 rest3 = rows[3] - (plane + (tilt + tilt));
    constexpr float kThird = 1.0F / 3.0F;
    const Float4 near = kThird * (rest1 + rest1 + rest2);
    const Float4 far = kThird * (rest1 + rest2 + rest2);
    // A Bezier point at the border between two cells is the mean of its neighbours.
    const Float4 begin = 0.5F * (kThird * (rest0 + rest1 + rest1) + near);
    const Float4 end = 0.5F * (far + kThird * (rest2 + rest2 + rest3));
    const float most = extreme<Greater>(columns(Greater()(Greater()(begin, near), Greater()(far, end))));
    const float least = extreme<Less>(columns(Less()(Less()(begin, near), Less()(far, end))));
    const float from =
        static_cast<float>(from_z - double{base_}) - (tilt_right * right_[0] + tilt_down * down_[0]);
    const float to = static_cast<float>(from_z + rise - double{base_}) -
                     (tilt_right * static_cast<float>(right) + tilt_down * static_cast<float>(down));
    return {std::min(from, to) - most, std::max(from, to) - least, to - most};
  }

  CurvedSplineValue evaluate_with_curvature() const noexcept {
    const Columns columns = columns_at_fraction();
    const Float4 across = weights(right_);
    const Float4 slope = slope_weights(right_);
    const Float4 s =
        sums(columns.value * slope, columns.slope * across, columns.value * across, columns.slope * slope);
    const Float4 c = sums(columns.value * curvature_weights(right_), columns.curvature * across);
    const Pair rest = pair_of(__builtin_shufflevector(s, s, 2, 3, 2, 3));
    return {double{base_} + rest[0], pair_of(s), pair_of(c), rest[1]};
  }

 private:
  using Float4 = float __attribute__((vector_size(16)));
  using Float2 = float __attribute__((vector_size(8)));
  using Int4 = int __attribute__((vector_size(16)));

  /// The first two lanes.
  static Pair pair_of(Float4 v) noexcept {
    return __builtin_convertvector(__builtin_shufflevector(v, v, 0, 1), Pair);
  }

  /// The cubic through each column of control values at the fraction down, above the base: its value and its
  /// derivatives.
  struct Columns {
    Float4 value;
    Float4 slope;
    Float4 curvature;
  };
  /// By differences of the rows, in Estrin's order. Fewer operations than sums of weighted rows, and only
  /// differences are rounded.
  Columns columns_at_fraction() const noexcept {
    constexpr float k = 1.0F / 6.0F;
    const Float4 t = down_;
    const Float4 before = rows_[0] - rows_[1];
    const Float4 after = rows_[2] - rows_[1];
    const Float4 second = before + after;
    const Float4 third = ((rows_[3] - rows_[2]) - after) - second;
    const Float4 half_t = 0.5F * t;
    const Float4 t2 = t * t;
    const Float4 first = after - before;
    return {
        ((rows_[1] - splat(base_)) + k * second + half_t * first) + t2 * (0.5F * second + (k * t) * third),
        (0.5F * first + t * second) + (0.5F * t2) * third, second + t * third};
  }

  struct Greater {
    Float4 operator()(Float4 a, Float4 b) const noexcept { return a > b ? a : b; }
  };
  struct Less {
    Float4 operator()(Float4 a, Float4 b) const noexcept { return a < b ? a : b; }
  };
  /// The Bezier points of the cubic whose control values are the lanes.
  static Float4 columns(Float4 v) noexcept {
    constexpr float k = 1.0F / 6.0F;
    return (spread<0>(v) * Float4{k, 0.0F, 0.0F, 0.0F} + spread<1>(v) * Float4{4 * k, 4 * k, 2 * k, k}) +
           (spread<2>(v) * Float4{k, 2 * k, 4 * k, 4 * k} + spread<3>(v) * Float4{0.0F, 0.0F, 0.0F, k});
  }
  template <class Of>
  static float extreme(Float4 v) noexcept {
    const Float4 pairs = Of()(v, __builtin_shufflevector(v, v, 2, 3, 0, 1));
    return Of()(pairs, spread<1>(pairs))[0];
  }

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

  /// The weights of each control value (first index) in the four Bezier points of the cubic between two
  /// positions: the blossoms of the weights above.
  static std::array<Float4, 4> bezier_weights(Float4 from, Float4 to) noexcept {
    constexpr float k = 1.0F / 6.0F;
    const Float4 a{from[0], from[0], from[0], to[0]};
    const Float4 b{from[0], from[0], to[0], to[0]};
    const Float4 c{from[0], to[0], to[0], to[0]};
    const Float4 sum = a + b + c;
    const Float4 pairs = a * b + (a + b) * c;
    const Float4 all = a * b * c;
    const Float4 one = splat(1.0F);
    return {splat(k) * (one - sum + pairs - all), splat(k) * (splat(4.0F) - 2.0F * pairs + 3.0F * all),
            splat(k) * (one + sum + pairs - 3.0F * all), splat(k) * all};
  }

  std::array<Float4, 4> rows_above_base() const noexcept {
    const Float4 base = splat(base_);
    return {rows_[0] - base, rows_[1] - base, rows_[2] - base, rows_[3] - base};
  }

  /// Row `j` of the patch's Bezier points.
  template <int j>
  static Float4 bezier_row(const std::array<Float4, 4>& rows, const std::array<Float4, 4>& downwards,
                           const std::array<Float4, 4>& across) noexcept {
    const Float4 row = (spread<j>(downwards[0]) * rows[0] + spread<j>(downwards[1]) * rows[1]) +
                       (spread<j>(downwards[2]) * rows[2] + spread<j>(downwards[3]) * rows[3]);
    return (spread<0>(row) * across[0] + spread<1>(row) * across[1]) +
           (spread<2>(row) * across[2] + spread<3>(row) * across[3]);
  }

  /// The sums of the lanes of two vectors, as the first two lanes.
  static Float4 sums(Float4 a, Float4 b) noexcept {
    const Float4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5) + __builtin_shufflevector(a, b, 2, 6, 3, 7);
    return ab + __builtin_shufflevector(ab, ab, 2, 3, 2, 3);
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
