// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/depth_filling.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace palpable::vision {
namespace {

// The depths that other maps give the unknown pixels of one map.
class Candidates {
 public:
  explicit Candidates(const PosedDepthMap& map) : map_(map), of_pixel_(map.depth.depth_m.count(), kKnown) {
    const auto depths = map.depth.depth_m.values();
    for (std::size_t i = 0; i < depths.size(); ++i)
      if (!(depths[i] > 0)) of_pixel_[i] = unknown_++;
    depths_.resize(unknown_);
  }

  void add(const PosedDepthMap& other) {
    const auto here_from_other = map_.pose.inverse() * other.pose;
    const Pinhole &there = *other.depth.camera, &here = *map_.depth.camera;
    const Raster<float>& depths = other.depth.depth_m;
    for (int y = 0; y < depths.height(); ++y)
      for (int x = 0; x < depths.width(); ++x) {
        const double z = static_cast<double>(depths(x, y));
        if (!(z > 0)) continue;
        const Vec3 p = (here_from_other *
                        Point<CameraFrame>{{(x - there.cx) / there.fx * z, (y - there.cy) / there.fy * z, z}})
                           .v;
        if (p.z > 0)
          add(here.fx * p.x / p.z + here.cx, here.fy * p.y / p.z + here.cy, static_cast<float>(p.z));
      }
  }

  Raster<float> filled(const FillingOptions& options) {
    Raster<float> out = map_.depth.depth_m;
    for (std::size_t i = 0; i < of_pixel_.size(); ++i)
      if (of_pixel_[i] != kKnown) out.values()[i] = best(depths_[of_pixel_[i]], options);
    return out;
  }

 private:
  static constexpr auto kKnown = static_cast<std::size_t>(-1);

  void add(double u, double v, float depth) {
    const Raster<float>& here = map_.depth.depth_m;
    if (!(u > -0.5 && v > -0.5 && u < here.width() - 0.5 && v < here.height() - 0.5)) return;
    const auto pixel = static_cast<std::size_t>(std::lround(v)) * static_cast<std::size_t>(here.width()) +
                       static_cast<std::size_t>(std::lround(u));
    if (of_pixel_[pixel] != kKnown) depths_[of_pixel_[pixel]].push_back(depth);
  }

  static float best(std::vector<float>& depths, const FillingOptions& options) {
    std::sort(depths.begin(), depths.end());
    const auto beyond = static_cast<float>(1 + options.tolerance);
    float best = kUnknownDepth;
    std::ptrdiff_t most = 0;
    for (auto from = depths.begin(); from != depths.end(); ++from) {
      const auto end = std::lower_bound(from, depths.end(), *from * beyond);
      if (end - from <= most) continue;
      most = end - from;
      best = *(from + most / 2);
    }
    return best;
  }

  const PosedDepthMap& map_;
  std::vector<std::size_t> of_pixel_;
  std::size_t unknown_ = 0;
  std::vector<std::vector<float>> depths_;
};

}  // namespace

std::vector<Parameter> parameters_of(FillingOptions& o) {
  return {{"tolerance", &o.tolerance, {0.0005, 0.1}, "", "Depths that differ by a smaller share agree"}};
}

Result<std::vector<PosedDepthMap>> filled_depth(std::span<const PosedDepthMap> maps,
                                                const FillingOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  std::vector<PosedDepthMap> out(maps.begin(), maps.end());
  parallel_for(work, static_cast<int>(maps.size()), 1, [&](int begin, int end) {
    for (auto self = static_cast<std::size_t>(begin); self < static_cast<std::size_t>(end); ++self) {
      if (work.cancelled()) return;
      Candidates candidates(maps[self]);
      for (std::size_t other = 0; other < maps.size(); ++other)
        if (other != self) candidates.add(maps[other]);
      out[self].depth.depth_m = candidates.filled(options);
    }
  });
  if (work.cancelled()) return Work::interrupted();
  return out;
}

}  // namespace palpable::vision
