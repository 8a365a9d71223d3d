// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <cstddef>

namespace palpable::sculpt {

/// Use of hints in sources made of triangles.
inline void enter_ball(const TriangleTree& tree, Vec3 centre_m, double radius_m, DistanceSource::Hint& hint) {
  // Making a shorter list would cost more than it saves.
  constexpr std::size_t kShort = 12;
  if (hint.entered > 0) {
    TriangleShortlist& last = hint.balls[hint.entered - 1];
    if (!last.is_whole && last.fours.size() <= kShort) {
      ++last.entered_again;
      return;
    }
  }
  if (hint.balls.size() == hint.entered) hint.balls.emplace_back();
  const TriangleShortlist* within = hint.entered == 0 ? nullptr : &hint.balls[hint.entered - 1];
  tree.list_near(centre_m, radius_m, hint.triangle, within, hint.balls[hint.entered]);
  ++hint.entered;
}
inline void leave_ball(DistanceSource::Hint& hint) {
  TriangleShortlist& last = hint.balls[hint.entered - 1];
  if (last.entered_again > 0)
    --last.entered_again;
  else
    --hint.entered;
}
inline NearestTriangle nearest_in_ball(const TriangleTree& tree, Vec3 p, const DistanceSource::Hint& hint) {
  return hint.entered == 0 ? tree.nearest(p, hint.triangle)
                           : tree.nearest(p, hint.triangle, hint.balls[hint.entered - 1]);
}

inline void remember(const NearestTriangle& near, Vec3 p, double distance_m, DistanceSource::Hint& hint) {
  hint.triangle = near.triangle;
  hint.last[hint.oldest++ % hint.last.size()] = {p, distance_m};
}

}  // namespace palpable::sculpt
