// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/seen_vertices.hpp"

#include <cmath>

namespace palpable::recipes {

std::vector<SeenVertex> seen_vertices(const Mesh& mesh, std::span<const Vec3> normals,
                                      const VideoReconstruction& video,
                                      const VideoReconstruction::Depth& view,
                                      const VideoColourOptions& options) {
  const auto camera_from_scene = view.world_from_camera.inverse() * video.scene_from_world.inverse();
  const Pinhole& camera = *view.map.camera;
  std::vector<SeenVertex> out(mesh.vertices_m.size());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Vec3 p = (camera_from_scene * Point<SceneFrame>{mesh.vertices_m[i]}).v;
    if (!(p.z > 0)) continue;
    const double u = camera.fx * p.x / p.z + camera.cx, v = camera.fy * p.y / p.z + camera.cy;
    const int x = static_cast<int>(std::lround(u)), y = static_cast<int>(std::lround(v));
    if (!view.picture.contains(x, y)) continue;
    const double facing = -dot(camera_from_scene.rotate(normals[i]), unit(p));
    const double depth = static_cast<double>(view.map.depth_m(x, y));
    if (facing > options.least_facing && std::abs(depth / p.z - 1) < options.depth_tolerance)
      out[i] = {u, v, facing};
  }
  return out;
}

}  // namespace palpable::recipes
