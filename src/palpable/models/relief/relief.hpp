// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/models/relief/path_heights.hpp"
#include "palpable/models/relief/spline_block.hpp"

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

namespace palpable::models {

/// A straight path within one cell of a cubic spline.
class CellPath {
 public:
  /// It begins at `from` and ends at the fractions `right` and `down`, both of which may be beyond the cell's
  /// border by rounding; its height is `from_z`, and it rises by `rise`.
  CellPath(const SplinePlace& from, double right, double down, double from_z, double rise) noexcept
      : block_(from), right_(right), down_(down), from_z_(from_z), rise_(rise) {}

  /// Bounds of its height above the surface. Tick path.
  PathBounds bounds() const noexcept { return block_.path_bounds(right_, down_, from_z_, rise_); }
  /// Its height above the surface. Tick path.
  PathHeights heights() const noexcept {
    return PathHeights(block_.path_above(right_, down_, from_z_, rise_));
  }

 private:
  SplineBlock block_;
  double right_;
  double down_;
  double from_z_;
  double rise_;
};

/// Height above the base and its exact gradient at one position of a height field.
struct HeightSample {
  double z_m = 0.0;
  double dzdx = 0.0;
  double dzdy = 0.0;
};

/// The same with its exact second derivatives, in 1/m.
struct CurvedSample {
  double z_m = 0.0;
  double dzdx = 0.0;
  double dzdy = 0.0;
  double dzdxx_per_m = 0.0;
  double dzdxy_per_m = 0.0;
  double dzdyy_per_m = 0.0;
};

/// The horizontal part of a vector.
inline Pair level_of(Vec3 v) noexcept { return Pair{v.x, v.y}; }

/// The same in pairs, for a law's arithmetic: the slope along x and y, the second derivatives twice along x
/// and twice along y, and that along both.
struct PairedSample {
  Pair slope{};
  Pair bend_per_m{};
  double z_m = 0.0;
  double twist_per_m = 0.0;

  CurvedSample curved() const noexcept {
    return {z_m, slope[0], slope[1], bend_per_m[0], twist_per_m, bend_per_m[1]};
  }
};

/// The interface that laws need of a surface z(x, y): height and slope, both continuous. Never allocates,
/// locks or throws.
template <class M>
concept HeightField = requires(const M& m, double x_m, double y_m) {
  { m.sample(x_m, y_m) } -> std::same_as<HeightSample>;
  requires noexcept(m.sample(x_m, y_m));
};

/// The additional interface for following a surface closely: curvature, a bound of the slope, the resolution
/// (its pixel), and a prefetch for a later query. Never allocates, locks or throws.
template <class M>
concept CurvedHeightField = HeightField<M> && requires(const M& m, double x_m, double y_m) {
  { m.paired_sample(Pair{}) } -> std::same_as<PairedSample>;
  { m.steepest_slope() } -> std::same_as<double>;
  { m.pixel_m() } -> std::same_as<double>;
  m.prefetch(Vec3{}, Vec3{});
  m.prefetch(x_m, y_m);
  requires noexcept(m.paired_sample(Pair{}))&& noexcept(m.prefetch(Vec3{}, Vec3{}))&& noexcept(
      m.prefetch(x_m, y_m));
};

/// A height field z(x, y) over a rectangle centred on the scene's origin: a uniform cubic B-spline whose
/// control values are the samples (approximating: the surface stays within the extremes of its 4 x 4
/// samples), so height, slope and curvature are continuous. Sample (i, j), j counted downwards, is at x = (i
/// - (w-1)/2) pixel_m, y = -(j - (h-1)/2) pixel_m. Outside the rectangle the border continues outwards at
/// constant height; the slope falls to zero continuously. Immutable; any thread.
class Relief {
 public:
  /// Errors: fewer than 2 x 2 samples, more than 64 M samples, a sample that is not finite, pixel_m not in
  /// (0, 1].
  static Result<Relief> from_samples(Raster<float> height_m, double pixel_m);

  /// Height and exact gradient at (x_m, y_m), any finite value. Tick path.
  HeightSample sample(double x_m, double y_m) const noexcept;

  /// The same with the exact second derivatives, at little more cost. Tick path.
  CurvedSample curved_sample(double x_m, double y_m) const noexcept;
  /// The same at {x, y}, in pairs. Tick path.
  PairedSample paired_sample(Pair place_m) const noexcept;

  /// The straight path from a to b, both in one cell or on its border (of cell_walk()). Tick path.
  CellPath path_in_cell(Vec3 a, Vec3 b) const noexcept;

  /// Steps from cell to cell along the path from a to b, any finite values.
  CellWalk cell_walk(Vec3 a, Vec3 b) const noexcept {
    return {middle_x_px_ + a.x * pixels_per_m_, middle_y_px_ - a.y * pixels_per_m_,
            (b.x - a.x) * pixels_per_m_, (a.y - b.y) * pixels_per_m_};
  }

  /// Prefetches the samples for later queries in the rectangle between a and b, at most 12 pixels wide and
  /// high from a on, without waiting. Tick path.
  void prefetch(Vec3 a, Vec3 b) const noexcept;
  /// The same for a query at (x_m, y_m). Tick path.
  void prefetch(double x_m, double y_m) const noexcept;

  const Raster<float>& samples_m() const { return height_m_; }
  double pixel_m() const noexcept { return pixel_m_; }
  /// An upper bound of the slope |grad z|, from the samples' greatest differences.
  double steepest_slope() const noexcept { return steepest_slope_; }
  /// Extents along x and y, including the outer half pixels: columns * pixel_m, rows * pixel_m.
  double size_x_m() const { return pixel_m_ * height_m_.width(); }
  double size_y_m() const { return pixel_m_ * height_m_.height(); }
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }
  std::size_t memory_bytes() const;

 private:
  Relief() = default;
  SplinePlace place_at(Pair place_m, std::array<float, 16>& copy) const noexcept;
  /// Whether the cell's 4 x 4 samples all exist; false for NaN, which border_place() clamps.
  bool is_inside(double x_px, double y_px) const noexcept {
    return x_px >= 1.0 && x_px < inside_x_px_ && y_px >= 1.0 && y_px < inside_y_px_;
  }
  SplinePlace inside_place(Pair place_px) const noexcept;
  SplinePlace border_place(double x_px, double y_px, std::array<float, 16>& copy) const noexcept;

  Raster<float> height_m_;
  double pixel_m_ = 0.0;
  double pixels_per_m_ = 0.0;
  /// The scene's origin in pixels, and the end of the cells whose 4 x 4 samples all exist.
  double middle_x_px_ = 0.0;
  double middle_y_px_ = 0.0;
  double inside_x_px_ = 0.0;
  double inside_y_px_ = 0.0;
  double steepest_slope_ = 0.0;
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
};

// Inline, since a call with its result in memory would cost a third of a query.
inline SplinePlace Relief::place_at(Pair place_m, std::array<float, 16>& copy) const noexcept {
  const Pair place_px = Pair{middle_x_px_, middle_y_px_} + place_m * Pair{pixels_per_m_, -pixels_per_m_};
  return is_inside(place_px[0], place_px[1]) ? inside_place(place_px)
                                             : border_place(place_px[0], place_px[1], copy);
}

inline SplinePlace Relief::inside_place(Pair place_px) const noexcept {
  // As the compiler's vectors, a conversion to an integer and back takes half as long.
  using IntPair = std::int32_t __attribute__((vector_size(8)));
  const auto cell = __builtin_convertvector(place_px, IntPair);
  const auto stride = static_cast<std::size_t>(height_m_.width());
  return {height_m_.data() + static_cast<std::size_t>(cell[1] - 1) * stride +
              static_cast<std::size_t>(cell[0] - 1),
          stride, place_px - __builtin_convertvector(cell, Pair)};
}

// Forced inline: g++ removes calls of a function that only prefetches, since it has no visible effect.
[[gnu::always_inline]] inline void Relief::prefetch(Vec3 a, Vec3 b) const noexcept {
  constexpr double kMost_px = 12.0;
  const double ax = middle_x_px_ + a.x * pixels_per_m_;
  const double ay = middle_y_px_ - a.y * pixels_per_m_;
  const double wide = std::max(-kMost_px, std::min((b.x - a.x) * pixels_per_m_, kMost_px));
  const double high = std::max(-kMost_px, std::min((a.y - b.y) * pixels_per_m_, kMost_px));
  const double left = std::min(ax, ax + wide);
  const double top = std::min(ay, ay + high);
  const double right = std::max(ax, ax + wide);
  const double bottom = std::max(ay, ay + high);
  if (!(left >= 1.0 && right < inside_x_px_ && top >= 1.0 && bottom < inside_y_px_)) return;
  const auto stride = static_cast<std::size_t>(height_m_.width());
  const auto first = static_cast<std::size_t>(static_cast<int>(left)) - 1;
  const auto last = static_cast<std::size_t>(static_cast<int>(right)) + 2;
  const auto end_row = static_cast<std::size_t>(static_cast<int>(bottom)) + 2;
  for (std::size_t row = static_cast<std::size_t>(static_cast<int>(top)) - 1; row <= end_row; ++row) {
    const float* const values = height_m_.data() + row * stride;
    __builtin_prefetch(values + first);
    __builtin_prefetch(values + last);
  }
}

[[gnu::always_inline]] inline void Relief::prefetch(double x_m, double y_m) const noexcept {
  const double x_px = middle_x_px_ + x_m * pixels_per_m_;
  const double y_px = middle_y_px_ - y_m * pixels_per_m_;
  if (!is_inside(x_px, y_px)) return;
  const SplinePlace place = inside_place(Pair{x_px, y_px});
  for (std::size_t row = 0; row < 4; ++row) {
    __builtin_prefetch(place.first + row * place.stride);
    __builtin_prefetch(place.first + row * place.stride + 3);
  }
}

inline HeightSample Relief::sample(double x_m, double y_m) const noexcept {
  std::array<float, 16> copy;
  const SplineValue value = SplineBlock(place_at(Pair{x_m, y_m}, copy)).evaluate();
  return {value.z, value.right * pixels_per_m_, -value.down * pixels_per_m_};
}

inline PairedSample Relief::paired_sample(Pair place_m) const noexcept {
  std::array<float, 16> copy;
  const CurvedSplineValue value = SplineBlock(place_at(place_m, copy)).evaluate_with_curvature();
  const double s = pixels_per_m_;
  const double s2 = s * s;
  return {value.slope * Pair{s, -s}, value.bend * s2, value.z, value.twist * -s2};
}

inline CurvedSample Relief::curved_sample(double x_m, double y_m) const noexcept {
  return paired_sample(Pair{x_m, y_m}).curved();
}

inline CellPath Relief::path_in_cell(Vec3 a, Vec3 b) const noexcept {
  std::array<float, 16> copy;
  const Vec3 half = 0.5 * (b - a);
  SplinePlace place = place_at(Pair{a.x + half.x, a.y + half.y}, copy);
  const Pair half_px{half.x * pixels_per_m_, -half.y * pixels_per_m_};
  const Pair end = place.fraction + half_px;
  place.fraction -= half_px;
  return {place, end[0], end[1], a.z, b.z - a.z};
}

}  // namespace palpable::models
