// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/occupancy_from_depth.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::sculpt {
namespace {

/// An empty lattice over a box, one point beyond it on every side but the base's.
Result<models::Occupancy> lattice_over(Vec3 least_m, Vec3 most_m, const OccupancyOptions& options) {
  const Vec3 size = most_m - least_m;
  if (options.resolution < 8 || options.resolution > 512)
    return Error{ErrorCode::usage, "a grid's resolution must be 8 to 512", {}};
  if (!is_finite(size) || !(size.x > 0.0 && size.y > 0.0 && size.z > 0.0))
    return Error{ErrorCode::usage, "a grid's box must have a width, a height and a depth", {}};
  models::Occupancy o;
  o.spacing_m = std::max({size.x, size.y, size.z}) / options.resolution;
  o.origin_m = least_m - Vec3{o.spacing_m, o.spacing_m, o.spacing_m};
  const auto count = [&](double side) { return static_cast<int>(std::ceil(side / o.spacing_m)) + 3; };
  o.counts = {count(size.x), count(size.y), count(size.z)};
  const double points = double{1.0} * o.counts[0] * o.counts[1] * o.counts[2];
  if (points > static_cast<double>(models::kMaxGridPoints))
    return Error{
        ErrorCode::usage, "a grid of more than 33 million points is not made: lower the resolution", {}};
  o.occupied.resize(static_cast<std::size_t>(points));
  return o;
}

Vec3 place_of(const models::Occupancy& o, int x, int y, int z) {
  return o.origin_m + o.spacing_m * Vec3{double{1.0} * x, double{1.0} * y, double{1.0} * z};
}

enum class Seen { nothing, free, behind };

Seen seen_by(const DepthView& view, const Transform<CameraFrame, SceneFrame>& camera_from_scene, Vec3 p,
             double fill_m) {
  const Pinhole& camera = *view.depth->camera;
  const Vec3 c = (camera_from_scene * Point<SceneFrame>{p}).v;
  if (!(c.z > 0.0)) return Seen::nothing;
  const double u = std::round(camera.fx * c.x / c.z + camera.cx);
  const double v = std::round(camera.fy * c.y / c.z + camera.cy);
  const Raster<float>& depth = view.depth->depth_m;
  if (!(u >= 0.0 && v >= 0.0 && u < depth.width() && v < depth.height())) return Seen::nothing;
  const double surface = depth(static_cast<int>(u), static_cast<int>(v));
  if (!std::isfinite(surface)) return Seen::nothing;
  if (c.z < surface) return Seen::free;
  return fill_m > 0.0 && c.z > surface + fill_m ? Seen::nothing : Seen::behind;
}

}  // namespace

Result<models::Occupancy> occupancy_from_relief(const models::Relief& relief,
                                                const OccupancyOptions& options) {
  const Vec3 half{0.5 * relief.size_x_m(), 0.5 * relief.size_y_m(), 0.0};
  const Vec3 top{half.x, half.y, std::max(relief.highest_m(), 1e-4)};
  auto made = lattice_over(-half, top, options);
  if (!made) return made;
  models::Occupancy& o = *made;
  for (int y = 0; y < o.counts[1]; ++y)
    for (int x = 0; x < o.counts[0]; ++x) {
      const Vec3 p = place_of(o, x, y, 0);
      if (std::abs(p.x) > half.x || std::abs(p.y) > half.y) continue;
      const double height = relief.sample(p.x, p.y).z_m;
      for (int z = 0; z < o.counts[2]; ++z)
        o.occupied[o.index(x, y, z)] = place_of(o, x, y, z).z <= height ? 1 : 0;
    }
  return made;
}

Result<models::Occupancy> occupancy_from_depth(std::span<const DepthView> views, const VolumeBox& box,
                                               const OccupancyOptions& options, const Work& work) {
  for (const DepthView& view : views) {
    if (view.depth == nullptr || !view.depth->camera)
      return invalid_input("a depth map without its camera cannot be filled into a grid");
    const Raster<float>& depth = view.depth->depth_m;
    if (depth.width() != view.depth->camera->width || depth.height() != view.depth->camera->height)
      return invalid_input("a depth map has another size than its camera");
  }
  auto made = lattice_over(box.least_m, box.most_m, options);
  if (!made) return made;
  models::Occupancy& o = *made;
  std::vector<Transform<CameraFrame, SceneFrame>> cameras;
  for (const DepthView& view : views) cameras.push_back(view.scene_from_camera.inverse());
  work.report(0.1, "filling the grid");
  parallel_for(work, o.counts[2], 1, [&](int begin, int end) {
    for (int z = begin; z < end && !work.cancelled(); ++z)
      for (int y = 0; y < o.counts[1]; ++y)
        for (int x = 0; x < o.counts[0]; ++x) {
          bool behind = false;
          bool free = false;
          for (std::size_t k = 0; k < views.size() && !free; ++k) {
            const Seen seen = seen_by(views[k], cameras[k], place_of(o, x, y, z), box.fill_m);
            free = seen == Seen::free;
            behind = behind || seen == Seen::behind;
          }
          o.occupied[o.index(x, y, z)] = behind && !free ? 1 : 0;
        }
  });
  if (work.cancelled()) return Work::interrupted();
  return made;
}

}  // namespace palpable::sculpt
