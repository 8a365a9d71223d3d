// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

namespace palpable::sculpt {

/// A solid's distance D near a surface, and an earlier field's E far from it, joined with a continuous
/// gradient: E + phi(u) (D - E), u = |D| / (|D| + within - s), where s is the distance to the surface
/// `around`. So the solid's own surface is where it is, wherever s < within; and under `around`, where s =
/// |D|, u is the depth in parts of `within`. phi falls from 1 to 0 as a cubic, from u = `whole` on;
/// where it does, the hint notes |D - E|.
class BlendedSource final : public DistanceSource {
 public:
  /// Up to this u the distance is the solid's own; 0 <= both < 1.
  struct Whole {
    double inside = 0.0, outside = 0.0;
  };
  /// All must outlive this. within_m > 0.
  BlendedSource(const DistanceSource& source, const models::DistanceField& earlier,
                const TriangleTree& around, double within_m, Whole whole)
      : source_(source), earlier_(earlier), around_(around), within_m_(within_m), whole_(whole) {}

  models::FieldSample at(Vec3 place_m, Hint& hint) const override;
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override {
    source_.enter(centre_m, radius_m, hint);
  }
  void leave(Hint& hint) const override { source_.leave(hint); }
  Box bounds() const override { return source_.bounds(); }

 private:
  const DistanceSource& source_;
  const models::DistanceField& earlier_;
  const TriangleTree& around_;
  double within_m_;
  Whole whole_;
};

}  // namespace palpable::sculpt
