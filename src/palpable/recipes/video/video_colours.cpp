// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_colours.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace palpable::recipes {
namespace {

struct ColourSum {
  std::array<double, 3> sum{};
  double weight = 0.0;

  void add(const Rgb8& colour, double by) {
    sum[0] += by * colour.r, sum[1] += by * colour.g, sum[2] += by * colour.b;
    weight += by;
  }
  Rgb8 mean() const {
    const auto level = [&](std::size_t i) { return static_cast<std::uint8_t>(std::lround(sum[i] / weight)); };
    return {level(0), level(1), level(2)};
  }
};

// Adds what one frame shows of the vertices.
void add_view(const Mesh& mesh, const std::vector<Vec3>& normals, const VideoReconstruction& video,
              const VideoReconstruction::Depth& view, const VideoColourOptions& options,
              std::vector<ColourSum>& sums) {
  const auto camera_from_scene = view.world_from_camera.inverse() * video.scene_from_world.inverse();
  const Pinhole& camera = *view.map.camera;
  for (std::size_t i = 0; i < mesh.vertices_m.size(); ++i) {
    const Vec3 p = (camera_from_scene * Point<SceneFrame>{mesh.vertices_m[i]}).v;
    if (!(p.z > 0)) continue;
    const int x = static_cast<int>(std::lround(camera.fx * p.x / p.z + camera.cx)),
              y = static_cast<int>(std::lround(camera.fy * p.y / p.z + camera.cy));
    if (x < 0 || y < 0 || x >= view.picture.width() || y >= view.picture.height()) continue;
    const double facing = -dot(camera_from_scene.rotate(normals[i]), unit(p));
    const double depth = static_cast<double>(view.map.depth_m(x, y));
    if (facing > options.least_facing && std::abs(depth / p.z - 1) < options.depth_tolerance)
      sums[i].add(view.picture(x, y), facing);
  }
}

// Colours from neighbours, one edge further each time.
void spread(const Mesh& mesh, int times, std::vector<ColourSum>& sums) {
  for (int time = 0; time < times; ++time) {
    std::vector<ColourSum> next(sums.size());
    bool any = false;
    for (const auto& t : mesh.triangles)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t from = t[k], to = t[(k + 1) % 3];
        if (sums[from].weight > 0 && !(sums[to].weight > 0)) next[to].add(sums[from].mean(), 1.0), any = true;
        if (sums[to].weight > 0 && !(sums[from].weight > 0)) next[from].add(sums[to].mean(), 1.0), any = true;
      }
    if (!any) return;
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (next[i].weight > 0) sums[i] = next[i];
  }
}

}  // namespace

std::vector<Parameter> parameters_of(VideoColourOptions& o) {
  return {
      {"depth_tolerance",
       &o.depth_tolerance,
       {0.001, 0.2},
       "",
       "Difference of depth at which a frame shows a vertex, share"},
      {"least_facing",
       &o.least_facing,
       {0, 1},
       "",
       "Cosine between normal and line of sight below which a frame does not count"},
      {"spread_times", &o.spread_times, {0, 1000}, "", "Edges over which colours spread to unseen vertices"}};
}

std::vector<Rgb8> colours_of(const Mesh& mesh, const VideoReconstruction& video,
                             const VideoColourOptions& options) {
  const std::vector<Vec3> normals = vertex_normals(mesh);
  std::vector<ColourSum> sums(mesh.vertices_m.size());
  for (const auto& view : video.depth_maps) add_view(mesh, normals, video, view, options, sums);
  spread(mesh, options.spread_times, sums);
  std::vector<Rgb8> out;
  out.reserve(sums.size());
  constexpr Rgb8 kUnseen{150, 150, 150};
  for (const ColourSum& sum : sums) out.push_back(sum.weight > 0 ? sum.mean() : kUnseen);
  return out;
}

}  // namespace palpable::recipes
