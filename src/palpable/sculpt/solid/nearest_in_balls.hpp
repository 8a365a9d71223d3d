// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cstdint>

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
/// Decides by the winding number whether places are inside a mesh.
struct InsideTest {
  const TriangleTree& tree;
  /// Parts of the mesh thinner than this, such as a sheet and its other face, are no solid, although the
  /// winding number between their faces is not 0, and in their plane has no value. 0: there are no such
  /// parts.
  double thinnest_m = 0.0;

  /// `surface_m`: the distance of the solid's surface from `p`, > 0.
  bool contains(Vec3 p, double surface_m) const {
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    if (!(thinnest_m > 0.0) || !tree.any_within(p, thinnest_m, kNone)) return tree.winding(p) > 0.5;
    // The same side of the surface, beyond the sheet: most of four corners of a tetrahedron that is aligned
    // with no axis.
    constexpr double kBeyond = 5.0;
    constexpr std::array kCorners{Vec3{0.441, 0.637, 0.633}, Vec3{0.605, -0.17, -0.778},
                                  Vec3{-0.859, 0.395, -0.326}, Vec3{-0.187, -0.862, 0.471}};
    const double around_m = std::min(kBeyond * thinnest_m, 0.5 * surface_m);
    const auto inside = std::count_if(kCorners.begin(), kCorners.end(),
                                      [&](Vec3 way) { return tree.winding(p + around_m * way) > 0.5; });
    return inside > 2;
  }
};

/// Whether a place is inside: as one of the last places, if that is nearer than any surface, else by the
/// winding number. `surface_m`: its distance from the surface.
inline bool is_behind(const InsideTest& solid, Vec3 p, double surface_m, const DistanceSource::Hint& hint) {
  for (const auto& last : hint.last)
    if (squared_norm(p - last.place_m) < 0.99 * last.distance_m * last.distance_m)
      return last.distance_m < 0.0;
  return solid.contains(p, surface_m);
}
/// Whether a place is inside, decided by `normal` where it is nearest to a closed surface, on the `way` from
/// there.
inline bool is_behind(const InsideTest& solid, Vec3 p, Vec3 way, Vec3 normal,
                      const DistanceSource::Hint& hint) {
  // The nearest place is known to a few parts in ten thousand: a normal nearly at right angles decides
  // nothing.
  constexpr double kTelling = 0.1;
  const double height = dot(way, normal);
  if (height * height > kTelling * kTelling * squared_norm(way) * squared_norm(normal)) return height < 0.0;
  return is_behind(solid, p, norm(way), hint);
}
inline void remember(const NearestTriangle& near, Vec3 p, double distance_m, DistanceSource::Hint& hint) {
  hint.triangle = near.triangle;
  hint.last[hint.oldest++ % hint.last.size()] = {p, distance_m};
}

}  // namespace palpable::sculpt
