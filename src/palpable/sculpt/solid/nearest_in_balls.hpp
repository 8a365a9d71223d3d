// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

namespace palpable::sculpt {

/// How sources made of triangles use their hints.
inline void enter_ball(const TriangleTree& tree, Vec3 centre_m, double radius_m, DistanceSource::Hint& hint) {
  // A shorter list would cost more than the queries in the smaller ball save.
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
/// Whether a place is inside: as one of the last places, if that is nearer than any surface, else by the
/// winding number.
inline bool is_behind(const TriangleTree& tree, Vec3 p, const DistanceSource::Hint& hint) {
  for (const auto& last : hint.last)
    if (squared_norm(p - last.place_m) < 0.99 * last.distance_m * last.distance_m)
      return last.distance_m < 0.0;
  return tree.winding(p) > 0.5;
}
/// Whether a place is inside, decided by `normal` where it is nearest to a closed surface, on the `way` from
/// there.
inline bool is_behind(const TriangleTree& tree, Vec3 p, Vec3 way, Vec3 normal,
                      const DistanceSource::Hint& hint) {
  // The nearest place is known to a few parts in ten thousand: a normal nearly at right angles decides
  // nothing.
  constexpr double kTelling = 0.1;
  const double height = dot(way, normal);
  if (height * height > kTelling * kTelling * squared_norm(way) * squared_norm(normal)) return height < 0.0;
  return is_behind(tree, p, hint);
}
inline void remember(const NearestTriangle& near, Vec3 p, double distance_m, DistanceSource::Hint& hint) {
  hint.triangle = near.triangle;
  hint.last[hint.oldest++ % hint.last.size()] = {p, distance_m};
}

}  // namespace palpable::sculpt
