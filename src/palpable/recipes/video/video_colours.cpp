// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_colours.hpp"

#include "palpable/recipes/video/seen_vertices.hpp"

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
void add_view(const std::vector<SeenVertex>& seen, const Raster<Rgb8>& picture,
              std::vector<ColourSum>& sums) {
  for (std::size_t i = 0; i < seen.size(); ++i)
    if (seen[i].seen())
      sums[i].add(picture(static_cast<int>(std::lround(seen[i].x)), static_cast<int>(std::lround(seen[i].y))),
                  seen[i].facing);
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
  for (const auto& view : video.depth_maps)
    add_view(seen_vertices(mesh, normals, video, view, options), view.picture, sums);
  spread(mesh, options.spread_times, sums);
  std::vector<Rgb8> out;
  out.reserve(sums.size());
  constexpr Rgb8 kUnseen{150, 150, 150};
  for (const ColourSum& sum : sums) out.push_back(sum.weight > 0 ? sum.mean() : kUnseen);
  return out;
}

}  // namespace palpable::recipes
