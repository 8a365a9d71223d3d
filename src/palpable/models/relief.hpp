// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <concepts>
#include <cstddef>

namespace palpable::models {

/// Height above the base and its exact gradient, at one place of a height field.
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

/// What a law needs to feel a surface z(x, y): height and slope, both continuous. Never allocates, locks or
/// throws.
template <class M>
concept HeightField = requires(const M& m, double x_m, double y_m) {
  { m.sample(x_m, y_m) } -> std::same_as<HeightSample>;
  requires noexcept(m.sample(x_m, y_m));
};

/// What a law needs to follow such a surface closely: curvature, a bound of the slope, and the step within
/// which the surface hides nothing (its pixel). Never allocates, locks or throws.
template <class M>
concept CurvedHeightField = HeightField<M> && requires(const M& m, double x_m, double y_m) {
  { m.curved_sample(x_m, y_m) } -> std::same_as<CurvedSample>;
  { m.steepest_slope() } -> std::same_as<double>;
  { m.pixel_m() } -> std::same_as<double>;
  requires noexcept(m.curved_sample(x_m, y_m));
};

/// A height field z(x, y) over a rectangle centred on the scene's origin: a uniform cubic B-spline whose
/// control values are the samples (approximating: the surface stays within the extremes of its 4 x 4
/// samples), so height, slope and curvature are continuous. Sample (i, j), j counted downwards, stands at x =
/// (i - (w-1)/2) pixel_m, y = -(j - (h-1)/2) pixel_m. Outside the rectangle the border continues level
/// outwards (slope falls to zero continuously). Immutable; any thread.
class Relief {
 public:
  /// Errors: fewer than 2 x 2 samples, more than 64 M samples, a sample that is not finite, pixel_m not in
  /// (0, 1].
  static Result<Relief> from_samples(Raster<float> height_m, double pixel_m);

  /// Height and exact gradient at (x_m, y_m), any finite value. Tick path.
  HeightSample sample(double x_m, double y_m) const noexcept;

  /// The same with the exact second derivatives; costs little more. Tick path.
  CurvedSample curved_sample(double x_m, double y_m) const noexcept;

  const Raster<float>& samples_m() const { return height_m_; }
  double pixel_m() const noexcept { return pixel_m_; }
  /// A bound that no slope |grad z| of the surface exceeds: from the samples' greatest differences.
  double steepest_slope() const noexcept { return steepest_slope_; }
  /// Size between the outermost samples' outer edges: width * pixel_m, height * pixel_m.
  double width_m() const { return pixel_m_ * height_m_.width(); }
  double depth_m() const { return pixel_m_ * height_m_.height(); }
  double lowest_m() const { return lowest_m_; }
  double highest_m() const { return highest_m_; }
  std::size_t memory_bytes() const;

 private:
  Relief() = default;
  Raster<float> height_m_;
  double pixel_m_ = 0.0;
  double pixels_per_m_ = 0.0;
  double steepest_slope_ = 0.0;
  double lowest_m_ = 0.0;
  double highest_m_ = 0.0;
};

}  // namespace palpable::models
