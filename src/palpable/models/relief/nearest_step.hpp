// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace palpable::models {

/// Two components at once, as the compiler's vector type.
using Pair = double __attribute__((vector_size(16)));

/// A horizontal step, in metres.
struct GroundStep {
  double dx = 0.0;
  double dy = 0.0;
};

/// The way from a surface point to a given point. Half its squared length is a function of the surface
/// point's horizontal position; `down_x` and `down_y` are its negative gradient.
struct WayFromSurface {
  Vec3 d;
  double whole2;
  double down_x;
  double down_y;
};

/// `d`: the vector from a surface point to the given point; `s`: the height field's derivatives there. Tick
/// path.
inline WayFromSurface way_from_surface(Vec3 d, const CurvedSample& s) noexcept {
  const Pair level{d.x, d.y};
  const Pair squares = level * level;
  const Pair down = level + d.z * Pair{s.dzdx, s.dzdy};
  return {d, (squares[0] + squares[1]) + d.z * d.z, down[0], down[1]};
}

/// Newton's step towards the surface point nearest to a given point. `s`: the height field's derivatives at
/// the current surface point, from which `way` leads to the given one. The step is scaled by `part`, in (0,
/// 1], and at most `longest_m` long. If the Hessian is not positive definite (a point far below a ridge), it
/// is a descent step of that length. Tick path.
inline GroundStep step_towards_nearest(const WayFromSurface& way, const CurvedSample& s, double part,
                                       double longest_m) noexcept {
  // Pairs' choices need no jumps: the processor does not foresee which kind of step it is. This is on the
  // tick's critical path.
  const auto swapped = [](auto p) { return __builtin_shufflevector(p, p, 1, 0); };
  constexpr double kLeast = 0.05;
  const Pair level = Pair{1.0, 1.0} + Pair{s.dzdx * s.dzdx, s.dzdy * s.dzdy};
  const Pair bent = level - way.d.z * Pair{s.dzdxx_per_m, s.dzdyy_per_m};
  const double level_xy = s.dzdx * s.dzdy;
  const double bent_xy = level_xy - way.d.z * s.dzdxy_per_m;
  const double bent_determinant = bent[0] * bent[1] - bent_xy * bent_xy;
  const double least_determinant = kLeast * (level[0] * level[1] - level_xy * level_xy);
  const auto exceeds = Pair{bent[0] + bent[1], bent_determinant} > Pair{0.0, least_determinant};
  const auto bends_rightly = exceeds & swapped(exceeds);
  // By bits: without SSE4.1, g++ makes jumps of the operator ?:.
  using Bits = std::remove_cv_t<decltype(exceeds)>;
  const auto chosen = [bends_rightly](Pair a, Pair b) {
    return reinterpret_cast<Pair>((bends_rightly & reinterpret_cast<Bits>(a)) |
                                  (~bends_rightly & reinterpret_cast<Bits>(b)));
  };
  const Pair diagonal = chosen(bent, level);
  const Pair rest = chosen(Pair{bent_xy, bent_determinant}, Pair{level_xy, least_determinant});
  const Pair down{way.down_x, way.down_y};
  const Pair whole = swapped(diagonal) * down - rest[0] * swapped(down);
  const double whole2 = whole[0] * whole[0] + whole[1] * whole[1];
  // The division does not wait for `part`.
  double along = part * (1.0 / rest[1]);
  // Long steps follow each other, so this jump is foreseen, and they do not wait for `part`.
  if (along * along * whole2 > longest_m * longest_m) along = longest_m / std::sqrt(whole2);
  return {along * whole[0], along * whole[1]};
}

}  // namespace palpable::models
