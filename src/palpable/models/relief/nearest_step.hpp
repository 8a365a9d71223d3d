// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/models/relief/relief.hpp"

#include <cmath>
#include <type_traits>

namespace palpable::models {

/// The way from a surface point to a given point: level and upwards. Half its squared length is a function of
/// the surface point's horizontal position; `down` is its negative gradient.
struct WayFromSurface {
  Pair level;
  double rise;
  double whole2;
  Pair down;
};

/// The sum of both components.
inline double sum_of(Pair p) noexcept { return p[0] + p[1]; }

/// `level` and `rise`: the vector from a surface point to the given point; `slope`: the height field's slope
/// there. Tick path.
inline WayFromSurface way_from_surface(Pair level, double rise, Pair slope) noexcept {
  return {level, rise, sum_of(level * level) + rise * rise, level + rise * slope};
}

/// A part of a step, in (0, 1]: of / per.
struct StepPart {
  double of = 1.0;
  double per = 1.0;
};

/// Newton's step, level, towards the surface point nearest to a given point. `s`: the height field at the
/// current surface point, from which `way` leads to the given one; `steep2`: 1 + slope^2 there. The step is
/// scaled by `part.of / part.per`, in (0, 1], and at most `longest_m` long. If the Hessian is not positive
/// definite (a point far below a ridge), it is a descent step of that length. Tick path.
inline Pair step_towards_nearest(const WayFromSurface& way, const PairedSample& s, double steep2,
                                 StepPart part, double longest_m) noexcept {
  // Pairs' choices need no jumps: the processor does not foresee which kind of step it is. This is on the
  // tick's critical path.
  const auto swapped = [](auto p) { return __builtin_shufflevector(p, p, 1, 0); };
  constexpr double kLeast = 0.05;
  const Pair level = Pair{1.0, 1.0} + s.slope * s.slope;
  const Pair bent = level - way.rise * s.bend_per_m;
  const double level_xy = s.slope[0] * s.slope[1];
  const double bent_xy = level_xy - way.rise * s.twist_per_m;
  const double bent_determinant = bent[0] * bent[1] - bent_xy * bent_xy;
  // The determinant of the level part is 1 + slope^2.
  const double least_determinant = kLeast * steep2;
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
  const Pair whole = swapped(diagonal) * way.down - rest[0] * swapped(way.down);
  double along = part.of / (part.per * rest[1]);
  // Long steps follow each other, so this jump is foreseen.
  const double whole2 = sum_of(whole * whole);
  if (along * along * whole2 > longest_m * longest_m) along = longest_m / std::sqrt(whole2);
  return along * whole;
}

}  // namespace palpable::models
