// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/field/distance_field.hpp"
#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

namespace palpable::sculpt {

/// Blends a solid's distance D near a surface into an earlier field's distance E far from it, with a
/// continuous gradient: E + phi(u) (D - E), u = |D| / (|D| + within - s), where s is the distance to the
/// surface `around`. So the solid's surface is exact wherever s < within; below `around`, where s = |D|, u
/// is the depth over `within`. phi is a cubic from 1 at u = `whole` to 0 at u = 1. The hint records the
/// greatest |D - E| of the blend.
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

  models::DistanceSample at(Vec3 place_m, Hint& hint) const override;
  void enter(Vec3 centre_m, double radius_m, Hint& hint) const override {
    source_.enter(centre_m, radius_m, hint);
  }
  void leave(Hint& hint) const override { source_.leave(hint); }
  Box bounds() const override { return source_.bounds(); }

 private:
  models::DistanceSample earlier(Vec3 place_m) const;

  const DistanceSource& source_;
  const models::DistanceField& earlier_;
  const TriangleTree& around_;
  double within_m_;
  Whole whole_;
};

}  // namespace palpable::sculpt
