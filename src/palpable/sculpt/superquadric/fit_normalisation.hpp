// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"
#include "palpable/models/field/superquadric.hpp"

#include <span>

// Inside sculpt's sources only.
namespace palpable::sculpt {

/// Evidence moved and scaled so that its middle is 0 and its size about 1, and shapes moved alike and back.
struct Normalisation {
  Vec3 centre;
  double scale = 1.0;

  Vec3 in(Vec3 p) const { return (p - centre) / scale; }
  models::Superquadric in(models::Superquadric s) const {
    s.size_m = s.size_m / scale;
    s.bend_per_m *= scale;
    Vec3& t = s.scene_from_shape.translation_m;
    t = in(t);
    return s;
  }
  models::Superquadric out(models::Superquadric s) const {
    s.size_m *= scale;
    s.bend_per_m /= scale;
    Vec3& t = s.scene_from_shape.translation_m;
    t = scale * t + centre;
    return s;
  }
};

/// The median of the points, and that of their distances from it. Errors (invalid_input): fewer than 12
/// points, one that is not finite, all at one place, on one plane or line.
Result<Normalisation> normalisation_of(std::span<const Vec3> points);

}  // namespace palpable::sculpt
