// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/make/quick_video.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace palpable::session {
namespace {

// Each pixel is the mean of factor x factor pixels; incomplete blocks at the ends are left out.
Raster<Rgb8> reduced_by(const Raster<Rgb8>& picture, int factor) {
  Raster<Rgb8> out(picture.width() / factor, picture.height() / factor);
  const int count = factor * factor;
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      std::array<int, 3> sum{count / 2, count / 2, count / 2};
      for (int v = 0; v < factor; ++v)
        for (int u = 0; u < factor; ++u) {
          const Rgb8 p = picture(x * factor + u, y * factor + v);
          sum[0] += p.r, sum[1] += p.g, sum[2] += p.b;
        }
      const auto level = [&](std::size_t i) { return static_cast<std::uint8_t>(sum[i] / count); };
      out(x, y) = {level(0), level(1), level(2)};
    }
  return out;
}

}  // namespace

VideoInput quick_video(const VideoInput& video, const QuickVideo& options) {
  const Raster<Rgb8>& first = video.frames.front().picture;
  const int longest = std::max(first.width(), first.height());
  const int factor = (longest + options.longest_side_px - 1) / options.longest_side_px;
  const auto most = static_cast<std::size_t>(options.most_frames);
  const std::size_t step = (video.frames.size() + most - 1) / most;
  VideoInput out;
  for (std::size_t i = 0; i < video.frames.size(); i += step)
    out.frames.push_back({video.frames[i].number, reduced_by(video.frames[i].picture, factor)});
  const Pinhole& c = video.camera.pinhole;
  // Pixel centres are at integers.
  const auto centre = [factor](double at) { return (at + 0.5) / factor - 0.5; };
  out.camera = video.camera;
  out.camera.pinhole = {c.fx / factor, c.fy / factor,    centre(c.cx),
                        centre(c.cy),  c.width / factor, c.height / factor};
  out.reduction = video.reduction / factor;
  return out;
}

recipes::VideoRecipe quick_recipe(recipes::VideoRecipe recipe, const QuickVideo& options) {
  recipe.depth.maps = std::min(recipe.depth.maps, options.maps);
  recipe.depth.facing_too = 0;
  // Frames that are far apart do not show the camera's shake, from which the readout follows.
  recipe.motion.rolling_shutter = 0;
  recipe.tracks.most_points = std::min(recipe.tracks.most_points, options.most_points);
  recipe.tracks.least_distance_px = std::max(4.0, recipe.tracks.least_distance_px / 2);
  recipe.field.field.resolution = std::min(recipe.field.field.resolution, options.resolution);
  // The superquadrics alone are soon ready; their correction follows.
  if (recipe.surface == recipes::VideoSurface::corrected)
    recipe.surface = recipes::VideoSurface::superquadrics;
  recipe.grown = {};
  // Of the length's frame only the full video is sure to have a picture.
  recipe.length.reset();
  return recipe;
}

}  // namespace palpable::session
