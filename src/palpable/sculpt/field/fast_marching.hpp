// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/models/field/dense_field.hpp"

#include <vector>

namespace palpable::sculpt {

/// Distance and force at a lattice's places, four floats each (models::DenseContent::distance_and_force),
/// known at some places so far.
struct Front {
  models::Lattice lattice;
  std::vector<float> values;
  /// One for each place; at least one is known.
  std::vector<bool> known;
};

/// Spreads distances from the known places over the lattice in the order of their size (fast marching of
/// first order, Sethian 1996): |grad D| = 1 from the neighbours nearer to the surface. Each place takes their
/// sign, and their forces' mean, weighted by how the front comes from each (as Adalsteinsson & Sethian 1999
/// extend a velocity), of length 1. There is a known place on both sides of every face that the surface
/// crosses. Errors: interrupted.
Result<void> march(Front& front, const Work& work);

}  // namespace palpable::sculpt
