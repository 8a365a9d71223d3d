// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"

#include <concepts>

namespace palpable::models {

/// Distance to a surface in metres, negative inside the solid, and its exact gradient (of length near 1).
struct FieldSample {
  double distance_m = 0.0;
  Vector<SceneFrame> gradient;
};

/// The interface that laws need of a solid: distance and gradient. The force is smooth where they are
/// continuous. Never allocates, locks or throws.
template <class M>
concept DistanceSurface = requires(const M& m, Point<SceneFrame> place) {
  { m.sample(place) } -> std::same_as<FieldSample>;
  { m.cell_m() } -> std::same_as<double>;
  requires noexcept(m.sample(place));
};

}  // namespace palpable::models
