// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/map_view.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

/// Where the ray leaves the block of side `side` that it is in, at least a little beyond `t`.
double leave_block(Vec3 origin, Vec3 ray, double t, double side) {
  double nearest = t + side * 2.0;
  const auto axis = [&](double o, double d) {
    if (d == 0.0) return;
    const double cell = std::floor((o + t * d) / side) + (d > 0.0 ? 1.0 : 0.0);
    const double at = (cell * side - o) / d;
    if (at > t) nearest = std::min(nearest, at);
  };
  axis(origin.x, ray.x);
  axis(origin.y, ray.y);
  axis(origin.z, ray.z);
  return nearest;
}

/// The depth at which a ray enters a surface from outside; NaN if it meets none. `ray` has z = 1 in the
/// camera's frame.
float first_surface(const SurfaceMap& map, Vec3 origin, Vec3 ray) {
  const double length = norm(ray);
  const double side = map.block_m();
  const double voxel = map.options().voxel_m / length;
  float before = kUnknownDepth;
  double before_at = 0.0;
  for (double t = 0.01; t < map.options().far_m;) {
    const Vec3 p = origin + t * ray;
    const BlockPlace block{static_cast<int>(std::floor(p.x / side)), static_cast<int>(std::floor(p.y / side)),
                           static_cast<int>(std::floor(p.z / side))};
    if (!map.has_block(block)) {
      before = kUnknownDepth;
      t = leave_block(origin, ray, t, side) + 1e-6;
      continue;
    }
    float here = map.distance_m(p);
    if (std::isnan(here)) here = map.nearest_m(p);
    if (before > 0.0F && here <= 0.0F)
      return static_cast<float>(before_at + (t - before_at) * before / static_cast<double>(before - here));
    before = here;
    before_at = t;
    // Distances are truncated, and may be too large along a grazing ray.
    t += here > 0.0F ? std::max(0.5 * voxel, 0.7 * here / length) : voxel;
  }
  return kUnknownDepth;
}

}  // namespace

MapView view_of(const SurfaceMap& map, const Transform<WorldFrame, CameraFrame>& world_from_camera,
                const Pinhole& camera, const Known& known) {
  MapView view{Raster<float>(camera.width, camera.height, kUnknownDepth),
               Raster<float>(camera.width, camera.height, 0.0F)};
  for (int y = 0; y < camera.height; ++y)
    for (int x = 0; x < camera.width; ++x) {
      if (!known.empty() && std::isfinite(known(x, y))) continue;
      const Vec3 ray =
          world_from_camera.rotate({(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0});
      const float z = first_surface(map, world_from_camera.translation_m, ray);
      view.depth_m(x, y) = z;
      if (std::isfinite(z))
        view.seen_s(x, y) =
            static_cast<float>(map.seen_s(world_from_camera.translation_m + static_cast<double>(z) * ray));
    }
  return view;
}

}  // namespace palpable::vision
