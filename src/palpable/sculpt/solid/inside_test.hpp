// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/sculpt/solid/distance_source.hpp"
#include "palpable/sculpt/triangles/triangle_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace palpable::sculpt {

/// Tests by the winding number whether points are inside a mesh.
struct InsideTest {
  const TriangleTree& tree;
  /// Parts of the mesh thinner than this, such as a sheet and its reverse side, are not solid, although the
  /// winding number between their faces is not 0 and is undefined in their plane. 0: there are no such parts.
  double thinnest_m = 0.0;

  /// `surface_m`: the distance from `p` to the solid's surface, > 0.
  bool contains(Vec3 p, double surface_m) const {
    constexpr std::uint32_t kNone = 0xFFFFFFFFU;
    if (!(thinnest_m > 0.0) || !tree.any_within(p, thinnest_m, kNone)) return tree.winding(p) > 0.5;
    // Points on the same side of the surface, beyond the sheet: the majority of four corners of a tetrahedron
    // that is not aligned with any axis.
    constexpr double kBeyond = 5.0;
    constexpr std::array kCorners{Vec3{0.441, 0.637, 0.633}, Vec3{0.605, -0.17, -0.778},
                                  Vec3{-0.859, 0.395, -0.326}, Vec3{-0.187, -0.862, 0.471}};
    const double around_m = std::min(kBeyond * thinnest_m, 0.5 * surface_m);
    const auto inside = std::count_if(kCorners.begin(), kCorners.end(),
                                      [&](Vec3 way) { return tree.winding(p + around_m * way) > 0.5; });
    return inside > 2;
  }
};

/// Whether a point is inside: the same as at a previous point if no surface can lie between, else by the
/// winding number. `surface_m`: the point's distance from the surface. A segment that crosses the surface is
/// at least as long as both ends' distances together.
inline bool is_behind(const InsideTest& solid, Vec3 p, double surface_m, const DistanceSource::Hint& hint) {
  for (const auto& last : hint.last) {
    if (last.distance_m == 0.0) continue;
    const double clear_m = surface_m + std::abs(last.distance_m);
    if (squared_norm(p - last.place_m) < 0.99 * clear_m * clear_m) return last.distance_m < 0.0;
  }
  return solid.contains(p, surface_m);
}
/// Whether a point is inside, by the `normal` at the nearest point of a closed surface and the vector `way`
/// from there.
inline bool is_behind(const InsideTest& solid, Vec3 p, Vec3 way, Vec3 normal,
                      const DistanceSource::Hint& hint) {
  // The nearest point is accurate to a few parts in ten thousand, so a normal nearly orthogonal to `way`
  // decides nothing.
  constexpr double kTelling = 0.1;
  const double height = dot(way, normal);
  if (height * height > kTelling * kTelling * squared_norm(way) * squared_norm(normal)) return height < 0.0;
  return is_behind(solid, p, norm(way), hint);
}

}  // namespace palpable::sculpt
