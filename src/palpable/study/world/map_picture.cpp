// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/map_picture.hpp"

#include "palpable/vision/mapping/map_view.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::study {
namespace {

constexpr double kPixel_m = 0.01;
/// What is higher is not drawn from above.
constexpr double kCut_m = 2.1;

Rgb8 shade(Rgb8 colour, double light) {
  const auto part = [&](std::uint8_t c) {
    return static_cast<std::uint8_t>(std::clamp(light * c, 0.0, 255.0));
  };
  return {part(colour.r), part(colour.g), part(colour.b)};
}

void copy(const Raster<Rgb8>& from, Raster<Rgb8>& to, int left, int top) {
  for (int y = 0; y < from.height(); ++y)
    for (int x = 0; x < from.width(); ++x) to(left + x, top + y) = from(x, y);
}

Raster<Rgb8> map_from_above(const Room& room, const vision::SurfaceMap& map, int width, int height) {
  Raster<Rgb8> picture(width, height, {20, 20, 60});
  Raster<double> highest(width, height, -1.0);
  for (const auto& [p, unused] : map.surface()) {
    const int x = static_cast<int>((p.x + room.size_m.x / 2.0) / kPixel_m);
    const int y = static_cast<int>((room.size_m.y / 2.0 - p.y) / kPixel_m);
    if (p.z > kCut_m) continue;
    const double off_m = std::abs(distance_m(room, {p}));
    const Rgb8 colour = off_m <= 0.02   ? Rgb8{235, 235, 235}
                        : off_m <= 0.04 ? Rgb8{250, 220, 60}
                                        : Rgb8{240, 60, 50};
    // A point covers as much as a voxel, so that there are no gaps.
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u)
        if (picture.contains(u, v) && p.z > highest(u, v))
          highest(u, v) = p.z, picture(u, v) = shade(colour, 0.4 + 0.6 * p.z / kCut_m);
  }
  return picture;
}

Raster<Rgb8> truth_from_above(const Room& room, int width, int height) {
  Raster<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Point<WorldFrame> above{
          {(x + 0.5) * kPixel_m - room.size_m.x / 2.0, room.size_m.y / 2.0 - (y + 0.5) * kPixel_m, kCut_m}};
      const Hit hit = cast_ray(room, above, {{0, 0, -1}});
      const Rgb8 colour = hit.object == kFloor ? room.floor.colour
                          : hit.object < 0
                              ? room.walls.colour
                              : room.furniture[static_cast<std::size_t>(hit.object)].finish.colour;
      picture(x, y) = shade(colour, 0.4 + 0.6 * (kCut_m - hit.along) / kCut_m);
    }
  return picture;
}

Raster<Rgb8> depth_picture(const Raster<float>& depth_m) {
  Raster<Rgb8> picture(depth_m.width(), depth_m.height(), {20, 20, 160});
  for (std::size_t k = 0; k < depth_m.count(); ++k) {
    const float z = depth_m.values()[k];
    if (!std::isfinite(z)) continue;
    const auto grey = static_cast<std::uint8_t>(std::clamp(300.0F / (1.0F + 0.6F * z), 0.0F, 255.0F));
    picture.values()[k] = {grey, grey, grey};
  }
  return picture;
}

}  // namespace

Raster<Rgb8> map_picture(const Room& room, const MapRun& run, const Pinhole& camera) {
  const int width = static_cast<int>(room.size_m.x / kPixel_m);
  const int height = static_cast<int>(room.size_m.y / kPixel_m);
  // The pose after a third of the way: most of the view was seen from elsewhere too.
  const auto& pose = run.poses[run.poses.size() / 3];
  const auto view = vision::view_of(run.map, pose, camera);
  const int half = std::max(width, camera.width) + 4;
  Raster<Rgb8> picture(2 * half, height + 4 + camera.height, {255, 255, 255});
  copy(map_from_above(room, run.map, width, height), picture, 0, 0);
  copy(truth_from_above(room, width, height), picture, half, 0);
  copy(depth_picture(view.depth_m), picture, 0, height + 4);
  copy(depth_picture(render(room, pose, camera).depth_m), picture, half, height + 4);
  return picture;
}

}  // namespace palpable::study
