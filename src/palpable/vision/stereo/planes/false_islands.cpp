// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/false_islands.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace palpable::vision {
namespace {

constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};

/// The connected surface around `from`; its pixels get `number`.
std::vector<Pixel> surface_from(Pixel from, const Raster<float>& disparity, int number, float joined_px,
                                Raster<int>& surface) {
  std::vector<Pixel> pixels{from};
  surface(from.x, from.y) = number;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const Pixel p = pixels[i];
    for (const auto [dx, dy] : kBeside) {
      const int u = p.x + dx;
      const int v = p.y + dy;
      if (!surface.contains(u, v) || surface(u, v) != 0) continue;
      if (std::fabs(disparity(u, v) - disparity(p.x, p.y)) >= joined_px) continue;
      surface(u, v) = number;
      pixels.push_back({u, v});
    }
  }
  return pixels;
}

class Island {
 public:
  Island(const CostVolume& volume, const PlaneMap& map, const Raster<int>& surface,
         const std::vector<Pixel>& pixels, const FalseIslandOptions& options, const PlaneCostOptions& costs)
      : volume_(volume), map_(map), surface_(surface), pixels_(pixels), options_(options), costs_(costs) {}

  /// Some of the pixels around it that lie behind it.
  std::vector<Pixel> surroundings() const {
    std::vector<Pixel> all;
    for (const Pixel p : pixels_)
      for (const auto [dx, dy] : kBeside) {
        const Pixel q{p.x + dx, p.y + dy};
        if (!surface_.contains(q.x, q.y) || on_island(q)) continue;
        if (map_.disparity(q.x, q.y) < map_.disparity(p.x, p.y)) all.push_back(q);
      }
    std::vector<Pixel> some;
    const std::size_t step =
        std::max<std::size_t>(1, all.size() / static_cast<std::size_t>(options_.tried_planes));
    for (std::size_t i = step / 2; i < all.size(); i += step) some.push_back(all[i]);
    return some;
  }

  /// The island's matching cost, plus the additional cost of the pixels that it would occlude.
  float cost() const {
    float sum = 0.0F;
    for (const Pixel p : pixels_) {
      const float d = map_.disparity(p.x, p.y);
      sum += matching_cost(p, d);
      const float there = static_cast<float>(p.x) - d;
      for (int u = std::max(0, static_cast<int>(there)); u < p.x; ++u) {
        const float behind = map_.disparity(u, p.y);
        if (on_island({u, p.y}) || behind >= d - options_.joined_px) continue;
        if (std::fabs(static_cast<float>(u) - behind - there) > 0.5F) continue;
        sum += std::max(0.0F, costs_.hidden_cost - matching_cost({u, p.y}, behind));
      }
    }
    return sum;
  }

  float cost_on(Pixel plane) const {
    float sum = 0.0F;
    for (const Pixel p : pixels_) sum += matching_cost(p, continued(plane, p));
    return sum;
  }

  /// The disparity at `to` of the plane of the pixel `plane`.
  float continued(Pixel plane, Pixel to) const {
    return map_.disparity(plane.x, plane.y) +
           map_.slope_x(plane.x, plane.y) * static_cast<float>(to.x - plane.x) +
           map_.slope_y(plane.x, plane.y) * static_cast<float>(to.y - plane.y);
  }

 private:
  bool on_island(Pixel p) const {
    return surface_(p.x, p.y) == surface_(pixels_.front().x, pixels_.front().y);
  }

  float matching_cost(Pixel p, float disparity) const {
    return matching_cost_at(volume_, p.x, p.y, disparity, costs_.beyond_range_per_px);
  }

  const CostVolume& volume_;
  const PlaneMap& map_;
  const Raster<int>& surface_;
  const std::vector<Pixel>& pixels_;
  const FalseIslandOptions& options_;
  const PlaneCostOptions& costs_;
};

}  // namespace

std::vector<Parameter> parameters_of(FalseIslandOptions& o) {
  return {{"joined_px", &o.joined_px, {0.1, 10}, "px", "Neighbours on one surface differ by less"},
          {"largest_share",
           &o.largest_share,
           {0, 1},
           "",
           "Share of the picture that a tested surface covers at most"},
          {"tried_planes", &o.tried_planes, {1, 1000}, "", "Planes of the surroundings that are tried"}};
}

void remove_false_islands(const CostVolume& volume, const FalseIslandOptions& options,
                          const PlaneCostOptions& costs, PlaneMap& map, PlaneMap& start) {
  const auto largest =
      static_cast<std::size_t>(options.largest_share * static_cast<double>(volume.width) * volume.height);
  Raster<int> surface(volume.width, volume.height);
  int number = 0;
  for (int y = 0; y < volume.height; ++y)
    for (int x = 0; x < volume.width; ++x) {
      if (surface(x, y) != 0) continue;
      const std::vector<Pixel> pixels =
          surface_from({x, y}, map.disparity, ++number, options.joined_px, surface);
      if (pixels.size() > largest) continue;
      const Island island(volume, map, surface, pixels, options, costs);
      const std::vector<Pixel> planes = island.surroundings();
      if (planes.empty()) continue;
      Pixel best = planes.front();
      float least = island.cost_on(best);
      for (const Pixel plane : planes) {
        const float cost = island.cost_on(plane);
        if (cost < least) {
          least = cost;
          best = plane;
        }
      }
      if (least >= island.cost()) continue;
      std::vector<float> continued;
      for (const Pixel p : pixels) continued.push_back(island.continued(best, p));
      const float slope_x = map.slope_x(best.x, best.y);
      const float slope_y = map.slope_y(best.x, best.y);
      for (std::size_t i = 0; i < pixels.size(); ++i)
        for (PlaneMap* to : {&map, &start}) {
          to->disparity(pixels[i].x, pixels[i].y) = continued[i];
          to->slope_x(pixels[i].x, pixels[i].y) = slope_x;
          to->slope_y(pixels[i].x, pixels[i].y) = slope_y;
        }
    }
}

}  // namespace palpable::vision
