// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/region_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palpable::vision {
namespace {

RegionPlane plane_at(const PlaneMap& map, Pixel p) {
  const float sx = map.slope_x(p.x, p.y);
  const float sy = map.slope_y(p.x, p.y);
  return {map.disparity(p.x, p.y) - sx * static_cast<float>(p.x) - sy * static_cast<float>(p.y), sx, sy};
}

/// A plane and the sum of weights of the sampled pixels on it.
struct Supported {
  RegionPlane plane;
  float support = 0.0F;
};

/// The sampled pixels of one region.
struct Sample {
  std::vector<Pixel> pixels;
  std::vector<float> weight;
  const PlaneMap& map;

  float off(std::size_t i, const RegionPlane& plane) const {
    const Pixel p = pixels[i];
    return std::fabs(map.disparity(p.x, p.y) - plane.at(p.x, p.y));
  }
};

Supported most_supported(const Sample& sample, const RegionPlaneOptions& options) {
  Supported best;
  const std::size_t step =
      std::max<std::size_t>(1, sample.pixels.size() / static_cast<std::size_t>(options.tried_planes));
  for (std::size_t i = step / 2; i < sample.pixels.size(); i += step) {
    if (sample.weight[i] <= 0.0F) continue;
    const RegionPlane plane = plane_at(sample.map, sample.pixels[i]);
    float sum = 0.0F;
    for (std::size_t j = 0; j < sample.pixels.size(); ++j)
      sum += sample.weight[j] * std::max(0.0F, 1.0F - sample.off(j, plane) / options.on_plane_px);
    if (sum > best.support) best = {plane, sum};
  }
  return best;
}

std::array<RegionPlane, 2> planes_of(const std::vector<Pixel>& pixels, const PlaneMap& map,
                                     const Raster<float>& trust, const RegionPlaneOptions& options) {
  Sample sample{{}, {}, map};
  const std::size_t step =
      std::max<std::size_t>(1, pixels.size() / static_cast<std::size_t>(options.sampled_pixels));
  for (std::size_t i = step / 2; i < pixels.size(); i += step) {
    sample.pixels.push_back(pixels[i]);
    sample.weight.push_back(trust(pixels[i].x, pixels[i].y));
  }
  const Supported first = most_supported(sample, options);
  if (first.support <= 0.0F) {
    const RegionPlane any = plane_at(map, pixels.front());
    return {any, any};
  }
  for (std::size_t j = 0; j < sample.pixels.size(); ++j)
    if (sample.off(j, first.plane) < options.on_plane_px) sample.weight[j] = 0.0F;
  const Supported second = most_supported(sample, options);
  return {first.plane, second.support > 0.0F ? second.plane : first.plane};
}

}  // namespace

std::vector<Parameter> parameters_of(RegionPlaneOptions& o) {
  return {{"on_plane_px", &o.on_plane_px, {0.05, 10}, "px", "A pixel lies on a plane if it differs by less"},
          {"tried_planes", &o.tried_planes, {1, 1000}, "", "Planes tried in each region"},
          {"sampled_pixels",
           &o.sampled_pixels,
           {1, 100000},
           "px",
           "Pixels of a region that planes are compared with"}};
}

RegionPlanes planes_of_regions(const Regions& regions, const PlaneMap& map, const Raster<float>& trust,
                               const RegionPlaneOptions& options, const Work& work) {
  std::vector<std::vector<Pixel>> pixels(static_cast<std::size_t>(regions.count()));
  for (int y = 0; y < regions.of_pixel.height(); ++y)
    for (int x = 0; x < regions.of_pixel.width(); ++x)
      pixels[static_cast<std::size_t>(regions.of_pixel(x, y))].push_back({x, y});
  RegionPlanes out(pixels.size());
  parallel_for(work, regions.count(), 16, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      out[i] = planes_of(pixels[i], map, trust, options);
  });
  return out;
}

}  // namespace palpable::vision
