// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_scale.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace palpable::recipes {
namespace {

// The surface at a pixel, or at the nearest one whose depth is known.
std::optional<Vec3> surface_at(const vision::FrameDepth& map, vision::ImagePoint at, int reach_px) {
  const Raster<float>& depth = map.map.depth.depth_m;
  const int x = static_cast<int>(std::lround(at.x)), y = static_cast<int>(std::lround(at.y));
  double nearest = reach_px + 0.5, z = 0.0;
  for (int v = std::max(0, y - reach_px); v <= std::min(depth.height() - 1, y + reach_px); ++v)
    for (int u = std::max(0, x - reach_px); u <= std::min(depth.width() - 1, x + reach_px); ++u)
      if (const double distance = std::hypot(u - x, v - y); depth(u, v) > 0 && distance < nearest)
        nearest = distance, z = static_cast<double>(depth(u, v));
  if (!(z > 0)) return std::nullopt;
  const Pinhole& camera = *map.map.depth.camera;
  const Point<CameraFrame> place{{(at.x - camera.cx) / camera.fx * z, (at.y - camera.cy) / camera.fy * z, z}};
  return (map.map.pose * place).v;
}

}  // namespace

std::vector<Parameter> parameters_of(VideoScaleOptions& o) {
  std::vector<Parameter> out{
      {"reach_px", &o.reach_px, {0, 50}, "px", "Distance to the nearest known depth of a place"}};
  append_parameters(out, "marker", vision::parameters_of(o.marker));
  return out;
}

VideoScale scale_from_markers(std::span<const Raster<std::uint8_t>> greys, const vision::CameraMotion& motion,
                              const VideoScaleOptions& options, const Work& work) {
  const auto found = vision::scale_from_markers(greys, motion, options.marker, work);
  if (!found) return {};
  return {
      found->metres_per_unit,
      {Note(fmt::format("The marker of {} mm was found in {} frames: the scale is known to about {:.1f} %.",
                        found->side_mm, found->frames, 100 * found->difference))}};
}

VideoScale scale_from_length(const KnownLength& length, int frame_index,
                             std::span<const vision::FrameDepth> maps, const VideoScaleOptions& options) {
  const auto map = std::find_if(maps.begin(), maps.end(),
                                [&](const vision::FrameDepth& one) { return one.frame == frame_index; });
  if (map == maps.end())
    return {
        std::nullopt,
        {Note(fmt::format("The known length was not used: the camera's position in frame {} is not known.",
                          length.frame_number))}};
  const auto from = surface_at(*map, length.from, options.reach_px),
             to = surface_at(*map, length.to, options.reach_px);
  if (!from || !to) {
    const vision::ImagePoint at = from ? length.to : length.from;
    return {std::nullopt,
            {Note(fmt::format(
                "The known length was not used: no depth was found at {:.0f},{:.0f} of frame {}. Choose "
                "places with visible texture.",
                at.x, at.y, length.frame_number))}};
  }
  const double distance = norm(*to - *from);
  if (!(distance > 0))
    return {std::nullopt, {Note("The known length was not used: its two places are one.")}};
  return {length.length_m / distance,
          {Note(fmt::format("The known length of {:.1f} mm gives the scale.", 1000 * length.length_m))}};
}

}  // namespace palpable::recipes
