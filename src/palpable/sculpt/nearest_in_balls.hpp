// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/distance_source.hpp"
#include "palpable/sculpt/triangle_tree.hpp"

namespace palpable::sculpt {

/// What sources made of triangles keep in their hints.
inline void enter_ball(const TriangleTree& tree, Vec3 centre_m, double radius_m, DistanceSource::Hint& hint) {
  if (hint.balls.size() == hint.entered) hint.balls.emplace_back();
  const TriangleShortlist* within = hint.entered == 0 ? nullptr : &hint.balls[hint.entered - 1];
  tree.list_near(centre_m, radius_m, hint.triangle, within, hint.balls[hint.entered]);
  ++hint.entered;
}
inline NearestTriangle nearest_in_ball(const TriangleTree& tree, Vec3 p, const DistanceSource::Hint& hint) {
  return hint.entered == 0 ? tree.nearest(p, hint.triangle)
                           : tree.nearest(p, hint.triangle, hint.balls[hint.entered - 1]);
}
inline void remember(const NearestTriangle& near, Vec3 p, double distance_m, DistanceSource::Hint& hint) {
  hint.triangle = near.triangle;
  hint.place_m = p;
  hint.distance_m = distance_m;
}

}  // namespace palpable::sculpt
