// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace palpable::vision {
namespace {

// The depth of a surface as other maps measured it, converted to this map's camera.
class Neighbours {
 public:
  Neighbours(std::span<const PosedDepthMap> maps, std::size_t self) : maps_(maps), self_(self) {
    for (const PosedDepthMap& map : maps) there_from_self_.push_back(map.pose.inverse() * maps[self].pose);
  }

  // The depth that map `other` has at the projection of pixel (x, y) at `depth`, converted to this map's
  // camera; NaN if it has none.
  double depth_seen_by(std::size_t other, int x, int y, double depth) const {
    const Point<CameraFrame> there = there_from_self_[other] * point(maps_[self_], x, y, depth);
    const PosedDepthMap& map = maps_[other];
    const Pinhole& camera = *map.depth.camera;
    if (there.v.z <= 0) return std::nan("");
    const int u = static_cast<int>(std::lround(camera.fx * there.v.x / there.v.z + camera.cx));
    const int v = static_cast<int>(std::lround(camera.fy * there.v.y / there.v.z + camera.cy));
    if (!map.depth.depth_m.contains(u, v)) return std::nan("");
    // Along this map's viewing ray the relative difference of depths is the same.
    return depth * static_cast<double>(map.depth.depth_m(u, v)) / there.v.z;
  }

 private:
  static Point<CameraFrame> point(const PosedDepthMap& map, int x, int y, double depth) {
    const Pinhole& camera = *map.depth.camera;
    return {{(x - camera.cx) / camera.fx * depth, (y - camera.cy) / camera.fy * depth, depth}};
  }
  std::span<const PosedDepthMap> maps_;
  std::size_t self_;
  std::vector<Transform<CameraFrame, CameraFrame>> there_from_self_;
};

float agreed_depth(const Neighbours& neighbours, std::size_t count, std::size_t self, int x, int y,
                   float depth, const ConsistencyOptions& options) {
  double sum = depth;
  int agreeing = 0, contradicting = 0;
  for (std::size_t other = 0; other < count; ++other) {
    if (other == self) continue;
    const double seen = neighbours.depth_seen_by(other, x, y, depth);
    if (std::abs(seen - depth) < options.tolerance * depth)
      sum += seen, ++agreeing;
    else if (seen > 0)
      ++contradicting;
  }
  const bool kept =
      agreeing >= options.least_agreeing || (contradicting == 0 && agreeing >= options.least_uncontested);
  return kept ? static_cast<float>(sum / (agreeing + 1)) : kUnknownDepth;
}

// Makes surfaces of fewer than `least` pixels unknown.
void remove_small_patches(Raster<float>& depth, double least, double tolerance) {
  const auto width = static_cast<std::size_t>(depth.width());
  const std::span<float> values = depth.values();
  DisjointSets surfaces(values.size());
  const auto join_if_equal = [&](std::size_t a, std::size_t b) {
    if (std::abs(values[a] - values[b]) < tolerance * values[a]) surfaces.join(a, b);
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % width != 0) join_if_equal(i - 1, i);
    if (i >= width) join_if_equal(i - width, i);
  }
  std::vector<int> sizes(values.size(), 0);
  for (std::size_t i = 0; i < values.size(); ++i) ++sizes[surfaces.find(i)];
  for (std::size_t i = 0; i < values.size(); ++i)
    if (sizes[surfaces.find(i)] < least) values[i] = kUnknownDepth;
}

}  // namespace

std::vector<Parameter> parameters_of(ConsistencyOptions& o) {
  return {{"tolerance", &o.tolerance, {0.0005, 0.1}, "", "Depths that differ by a smaller share agree"},
          {"least_agreeing", &o.least_agreeing, {1, 16}, "", "Other maps that must agree with a pixel"},
          {"least_uncontested", &o.least_uncontested, {0, 16}, "", "The same where no map has another depth"},
          {"least_patch", &o.least_patch, {0, 0.01}, "", "Share of the picture that a surface must cover"}};
}

Result<std::vector<PosedDepthMap>> consistent_depth(std::span<const PosedDepthMap> maps,
                                                    const ConsistencyOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  std::vector<PosedDepthMap> out(maps.begin(), maps.end());
  for (std::size_t self = 0; self < maps.size(); ++self) {
    if (work.cancelled()) return Work::interrupted();
    const Neighbours neighbours(maps, self);
    Raster<float>& depth = out[self].depth.depth_m;
    parallel_for(work, depth.height(), 8, [&](int begin, int end) {
      for (int y = begin; y < end; ++y)
        for (int x = 0; x < depth.width(); ++x)
          depth(x, y) = agreed_depth(neighbours, maps.size(), self, x, y, depth(x, y), options);
    });
    remove_small_patches(depth, options.least_patch * static_cast<double>(depth.count()), options.tolerance);
  }
  return out;
}

}  // namespace palpable::vision
