// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/dense_field.hpp"

#include <vector>

namespace palpable::sculpt {

/// Distance and force at a lattice's points, four floats each (models::DenseContent::distance_and_force);
/// known at some points initially.
struct Front {
  models::Lattice lattice;
  std::vector<float> values;
  /// Whether each point is known; at least one is.
  std::vector<bool> known;
};

/// Extends distances from the known points over the lattice in increasing order (first-order fast marching,
/// Sethian 1996): |grad D| = 1 from the neighbours nearer to the surface. Each point gets their sign and the
/// mean of their forces, normalised to length 1 and weighted by the upwind directions (as Adalsteinsson &
/// Sethian 1999 extend a velocity). There must be a known point on both sides of every face that the surface
/// crosses. Errors: interrupted.
Result<void> march(Front& front, const Work& work);

}  // namespace palpable::sculpt
