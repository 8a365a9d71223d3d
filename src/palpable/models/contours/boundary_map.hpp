// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"

#include <concepts>
#include <cstddef>

namespace palpable::models {

/// The boundary at one place: an undirected unit tangent (scene axes; zero if no boundary is near) and its
/// strength 0 … 1.
struct BoundarySample {
  double tangent_x = 0.0;
  double tangent_y = 0.0;
  double strength = 0.0;
};

/// The interface that the law `tracing` needs: tangent and strength of the boundary near a place. Never
/// allocates, locks or throws.
template <class M>
concept BoundaryField = requires(const M& m, double x_m, double y_m) {
  { m.sample(x_m, y_m) } -> std::same_as<BoundarySample>;
  requires noexcept(m.sample(x_m, y_m));
};

/// One pixel of a boundary map: strength times cosine and sine of twice the tangent's angle (scene axes, y
/// up), so that opposite directions have the same value and can be interpolated.
struct BoundaryPixel {
  float c2 = 0.0F;
  float s2 = 0.0F;
  bool operator==(const BoundaryPixel&) const = default;
};

/// Statistics of a boundary map's edges, for `palpable info`.
struct BoundaryOrigin {
  /// Strength from which a pixel counts as boundary, and the share of pixels that do.
  double threshold = 0.0;
  double boundary_fraction = 0.0;
};

/// A picture's boundaries (graphic-haptic display 2006) over a rectangle centred on the scene's origin in the
/// plane z = 0: the edge vectors e, and their neighbourhood average b (eq. 7), which the law uses. Pixel (i,
/// j) has the position of Relief's sample (i, j). b is continuous between pixels (bilinear in the doubled
/// angle) and zero outside. Immutable; any thread.
class BoundaryMap {
 public:
  /// b = sum n(r) e / sum n(r); n falls linearly from 1 at r = 0 to 0 at r = radius_px (m of the paper, 1 ...
  /// 32 px). The average uses doubled angles, so that the two sides of a thin line add up instead of
  /// cancelling. Errors: fewer than 2 x 2 or more than 64 M pixels, a value not finite or longer than 1,
  /// pixel_m not in (0, 1], radius out of range.
  static Result<BoundaryMap> from_edges(Raster<BoundaryPixel> edges, double pixel_m, double radius_px,
                                        const BoundaryOrigin& origin, const Work& work);

  /// b at any finite position. Tick path.
  BoundarySample sample(double x_m, double y_m) const noexcept;

  const Raster<BoundaryPixel>& edges() const { return edges_; }
  const Raster<BoundaryPixel>& averaged() const { return averaged_; }
  const BoundaryOrigin& origin() const { return origin_; }
  double radius_px() const { return radius_px_; }
  double pixel_m() const { return pixel_m_; }
  /// Extents along x and y, including the outer half pixels.
  double size_x_m() const { return pixel_m_ * edges_.width(); }
  double size_y_m() const { return pixel_m_ * edges_.height(); }
  std::size_t memory_bytes() const { return 2 * edges_.count() * sizeof(BoundaryPixel); }

 private:
  BoundaryMap() = default;
  Raster<BoundaryPixel> edges_;
  Raster<BoundaryPixel> averaged_;
  BoundaryOrigin origin_;
  double radius_px_ = 0.0;
  double pixel_m_ = 0.0;
};

}  // namespace palpable::models
