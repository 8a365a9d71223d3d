// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstdint>
#include <vector>

namespace palpable::sculpt {

/// From where and how closely a surface is viewed.
struct ViewOptions {
  /// Directions, spread evenly over the sphere, and parallel rays along each, >= 1.
  int directions = 26;
  int rays = 160;
  /// What is seen only through gaps narrower than twice this is not counted, metres, >= 0.
  double beside_m = 0.0;
};

/// The places where rays from outside first meet triangles, whichever side they meet. Deterministic for
/// `seed`; about half of the rays meet a compact surface.
std::vector<Vec3> visible_places(const TriangleTree& tree, const ViewOptions& options, std::uint64_t seed);

}  // namespace palpable::sculpt
