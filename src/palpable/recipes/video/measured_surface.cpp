// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/measured_surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace palpable::recipes {
namespace {

constexpr std::uint32_t kNoCorner = std::numeric_limits<std::uint32_t>::max();

// The mean depth of the pixels around (x, y) that lie on its surface; unknown where fewer than half do.
double depth_around(const Raster<float>& depth, int x, int y, int step, double tolerance) {
  const double here = static_cast<double>(depth(x, y));
  if (!(here > 0)) return 0.0;
  const int half = step / 2;
  double sum = 0.0;
  int count = 0, all = 0;
  for (int v = std::max(0, y - half); v <= std::min(depth.height() - 1, y + half); ++v)
    for (int u = std::max(0, x - half); u <= std::min(depth.width() - 1, x + half); ++u, ++all)
      if (const double z = static_cast<double>(depth(u, v)); std::abs(z - here) <= tolerance * here)
        sum += z, ++count;
  return 2 * count > all ? sum / count : 0.0;
}

// The corners of a map's grid, and which of them are connected.
class CornerGrid {
 public:
  CornerGrid(const vision::FrameDepth& map, const VideoModel& model, const MeasuredSurfaceOptions& options)
      : width_((map.map.depth.depth_m.width() - 1) / options.step_px + 1),
        height_((map.map.depth.depth_m.height() - 1) / options.step_px + 1),
        depth_(width_, height_),
        corner_(width_, height_),
        step_(options.most_slope * options.step_px / map.map.depth.camera->fx) {
    const Pinhole& camera = *map.map.depth.camera;
    const auto axes_from_camera = model.axes.axes_from_world() * map.map.pose;
    for (int v = 0; v < height_; ++v)
      for (int u = 0; u < width_; ++u) {
        const int x = u * options.step_px, y = v * options.step_px;
        const double z = depth_around(map.map.depth.depth_m, x, y, options.step_px, step_);
        depth_(u, v) = z;
        corner_(u, v) = kNoCorner;
        if (z == 0.0) continue;
        corner_(u, v) = static_cast<std::uint32_t>(mesh.vertices_m.size());
        mesh.vertices_m.push_back(
            (axes_from_camera *
             Point<CameraFrame>{{(x - camera.cx) / camera.fx * z, (y - camera.cy) / camera.fy * z, z}})
                .v);
      }
  }
  // Two triangles for each square of four corners, divided where their depths differ less.
  void connect(double raised_above) {
    for (int v = 0; v + 1 < height_; ++v)
      for (int u = 0; u + 1 < width_; ++u) {
        const std::array<Place, 4> square{{{u, v}, {u, v + 1}, {u + 1, v + 1}, {u + 1, v}}};
        const bool first = difference(square[0], square[2]) <= difference(square[1], square[3]);
        const std::size_t from = first ? 0 : 1;
        add(square[from], square[from + 1], square[from + 2], raised_above);
        add(square[from], square[from + 2], square[(from + 3) % 4], raised_above);
      }
  }

  Mesh mesh;

 private:
  struct Place {
    int u, v;
  };
  double difference(Place a, Place b) const { return std::abs(depth_(a.u, a.v) - depth_(b.u, b.v)); }
  void add(Place a, Place b, Place c, double raised_above) {
    const std::array<std::uint32_t, 3> corners{corner_(a.u, a.v), corner_(b.u, b.v), corner_(c.u, c.v)};
    if (std::find(corners.begin(), corners.end(), kNoCorner) != corners.end()) return;
    const double most = step_ * depth_(a.u, a.v);
    if (difference(a, b) > most || difference(b, c) > most || difference(c, a) > most) return;
    if (std::all_of(corners.begin(), corners.end(),
                    [&](std::uint32_t i) { return mesh.vertices_m[i].z <= raised_above; }))
      return;
    mesh.triangles.push_back(corners);
  }

  int width_, height_;
  Raster<double> depth_;
  Raster<std::uint32_t> corner_;
  // Greatest difference of depth between neighbours, share of the depth.
  double step_;
};

}  // namespace

std::vector<Parameter> parameters_of(MeasuredSurfaceOptions& o) {
  return {{"step_px", &o.step_px, {1, 64}, "px", "Spacing of the corners of a measured surface"},
          {"most_slope",
           &o.most_slope,
           {1, 50},
           "",
           "Difference of depth over distance across the line of sight that cuts it"}};
}

Mesh measured_surface(const vision::FrameDepth& map, const VideoModel& model,
                      const MeasuredSurfaceOptions& options) {
  CornerGrid grid(map, model, options);
  grid.connect(model.raised_above);
  return std::move(grid.mesh);
}

}  // namespace palpable::recipes
