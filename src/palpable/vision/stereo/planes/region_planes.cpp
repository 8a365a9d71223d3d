// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/region_planes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palpable::vision {
namespace {

constexpr float kOnPlane_px = 0.7F;
/// Planes tried, and pixels asked about them, of each region.
constexpr std::size_t kTried = 24;
constexpr std::size_t kAsked = 400;

struct Pixel {
  int x, y;
};

RegionPlane plane_at(const PlaneMap& map, Pixel p) {
  const float sx = map.slope_x(p.x, p.y);
  const float sy = map.slope_y(p.x, p.y);
  return {map.disparity(p.x, p.y) - sx * static_cast<float>(p.x) - sy * static_cast<float>(p.y), sx, sy};
}

/// A plane and how many of the asked pixels lie on it, by their weights.
struct Supported {
  RegionPlane plane;
  float support = 0.0F;
};

/// The asked pixels of one region.
struct Asked {
  std::vector<Pixel> pixels;
  std::vector<float> weight;
  const PlaneMap& map;

  float off(std::size_t i, const RegionPlane& plane) const {
    const Pixel p = pixels[i];
    return std::fabs(map.disparity(p.x, p.y) - plane.at(p.x, p.y));
  }
};

Supported most_supported(const Asked& asked) {
  Supported best;
  const std::size_t step = std::max<std::size_t>(1, asked.pixels.size() / kTried);
  for (std::size_t i = step / 2; i < asked.pixels.size(); i += step) {
    if (asked.weight[i] <= 0.0F) continue;
    const RegionPlane plane = plane_at(asked.map, asked.pixels[i]);
    float sum = 0.0F;
    for (std::size_t j = 0; j < asked.pixels.size(); ++j)
      sum += asked.weight[j] * std::max(0.0F, 1.0F - asked.off(j, plane) / kOnPlane_px);
    if (sum > best.support) best = {plane, sum};
  }
  return best;
}

std::array<RegionPlane, 2> planes_of(const std::vector<Pixel>& pixels, const PlaneMap& map,
                                     const Raster<float>& trust) {
  Asked asked{{}, {}, map};
  const std::size_t step = std::max<std::size_t>(1, pixels.size() / kAsked);
  for (std::size_t i = step / 2; i < pixels.size(); i += step) {
    asked.pixels.push_back(pixels[i]);
    asked.weight.push_back(trust(pixels[i].x, pixels[i].y));
  }
  const Supported first = most_supported(asked);
  if (first.support <= 0.0F) {
    const RegionPlane any = plane_at(map, pixels.front());
    return {any, any};
  }
  for (std::size_t j = 0; j < asked.pixels.size(); ++j)
    if (asked.off(j, first.plane) < kOnPlane_px) asked.weight[j] = 0.0F;
  const Supported second = most_supported(asked);
  return {first.plane, second.support > 0.0F ? second.plane : first.plane};
}

}  // namespace

RegionPlanes planes_of_regions(const Regions& regions, const PlaneMap& map, const Raster<float>& trust,
                               const Work& work) {
  std::vector<std::vector<Pixel>> pixels(static_cast<std::size_t>(regions.count()));
  for (int y = 0; y < regions.of_pixel.height(); ++y)
    for (int x = 0; x < regions.of_pixel.width(); ++x)
      pixels[static_cast<std::size_t>(regions.of_pixel(x, y))].push_back({x, y});
  RegionPlanes out(pixels.size());
  parallel_for(work, regions.count(), 16, [&](int begin, int end) {
    for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i)
      out[i] = planes_of(pixels[i], map, trust);
  });
  return out;
}

}  // namespace palpable::vision
