// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/raster.hpp"
#include "palpable/core/result.hpp"

#include <concepts>
#include <cstddef>

namespace palpable::models {

/// The boundary at one place: a unit tangent without sign (scene axes; zero where nothing is near) and its
/// strength 0 … 1.
struct BoundarySample {
  double tangent_x = 0.0;
  double tangent_y = 0.0;
  double strength = 0.0;
};

/// What `tracing` needs: tangent and strength of the boundary near a place. Never allocates, locks or throws.
template <class M>
concept BoundaryField = requires(const M& m, double x_m, double y_m) {
  { m.sample(x_m, y_m) } -> std::same_as<BoundarySample>;
  requires noexcept(m.sample(x_m, y_m));
};

/// One pixel of a boundary map: strength times cosine and sine of twice the tangent's angle (scene axes, y
/// up), so that opposite directions are the same value and interpolate without a sign.
struct BoundaryPixel {
  float c2 = 0.0F;
  float s2 = 0.0F;
  bool operator==(const BoundaryPixel&) const = default;
};

/// A picture's boundaries as a density of directions (graphic-haptic display 2006, eq. 7), over a rectangle
/// centred on the scene's origin in the plane z = 0. Pixel (i, j) stands where Relief's sample (i, j) does.
/// Continuous between pixels (bilinear in the doubled angle); zero outside. Immutable; any thread.
class BoundaryMap {
 public:
  /// Errors: under 2 x 2 pixels or over 64 M, a value not finite or longer than 1, pixel_m not in (0, 1].
  static Result<BoundaryMap> from_pixels(Raster<BoundaryPixel> pixels, double pixel_m);

  /// Any finite place. Tick path.
  BoundarySample sample(double x_m, double y_m) const noexcept;

  const Raster<BoundaryPixel>& pixels() const { return pixels_; }
  double pixel_m() const { return pixel_m_; }
  double width_m() const { return pixel_m_ * pixels_.width(); }
  double depth_m() const { return pixel_m_ * pixels_.height(); }
  std::size_t memory_bytes() const { return pixels_.count() * sizeof(BoundaryPixel); }

 private:
  BoundaryMap() = default;
  Raster<BoundaryPixel> pixels_;
  double pixel_m_ = 0.0;
};

}  // namespace palpable::models
