// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/numbers/disjoint_sets.hpp"
#include "palpable/vision/motion/depth/multi_view_depth.hpp"

#include <cmath>
#include <span>
#include <vector>

namespace palpable::vision {
namespace {

// The depths of other maps, converted to this map's camera.
class Neighbours {
 public:
  Neighbours(std::span<const PosedDepthMap> maps, std::size_t self) : maps_(maps), self_(self) {
    for (const PosedDepthMap& map : maps) there_from_self_.push_back(map.pose.inverse() * maps[self].pose);
  }

  // The least depth that map `other` has within `reach` pixels of the projection of pixel (x, y) at `depth`;
  // NaN if it has none.
  double depth_seen_by(std::size_t other, int x, int y, double depth, int reach = 0) const {
    const Point<CameraFrame> there = there_from_self_[other] * point(maps_[self_], x, y, depth);
    const Raster<float>& depths = maps_[other].depth.depth_m;
    const Pinhole& camera = *maps_[other].depth.camera;
    if (there.v.z <= 0) return std::nan("");
    const int u = static_cast<int>(std::lround(camera.fx * there.v.x / there.v.z + camera.cx));
    const int v = static_cast<int>(std::lround(camera.fy * there.v.y / there.v.z + camera.cy));
    if (!depths.contains(u, v)) return std::nan("");
    float least = depths(u, v);
    for (int j = v - reach; j <= v + reach; ++j)
      for (int i = u - reach; i <= u + reach; ++i)
        if (depths.contains(i, j)) least = std::fmin(least, depths(i, j));
    // Along this map's viewing ray the relative difference of depths is the same.
    return depth * static_cast<double>(least) / there.v.z;
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
  // So far may the edges of a surface be apart in two maps.
  constexpr int kEdge_px = 1;
  const double farther = depth * (1 + options.tolerance);
  double sum = depth;
  int agreeing = 0, contradicting = 0, through = 0;
  for (std::size_t other = 0; other < count; ++other) {
    if (other == self) continue;
    const double seen = neighbours.depth_seen_by(other, x, y, depth);
    if (std::abs(seen - depth) < options.tolerance * depth) {
      sum += seen, ++agreeing;
    } else if (seen > 0) {
      ++contradicting;
      if (seen > farther && neighbours.depth_seen_by(other, x, y, depth, kEdge_px) > farther) ++through;
    }
  }
  const bool kept = (agreeing >= options.least_agreeing && through <= options.most_through * agreeing) ||
                    (contradicting == 0 && agreeing >= options.least_uncontested);
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

void keep_agreed(std::span<const PosedDepthMap> maps, std::size_t self, const ConsistencyOptions& options,
                 Raster<float>& depth, const Work& work) {
  const Neighbours neighbours(maps, self);
  parallel_for(work, depth.height(), 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < depth.width(); ++x)
        depth(x, y) = agreed_depth(neighbours, maps.size(), self, x, y, depth(x, y), options);
  });
  remove_small_patches(depth, options.least_patch * static_cast<double>(depth.count()), options.tolerance);
}

}  // namespace

std::vector<Parameter> parameters_of(ConsistencyOptions& o) {
  return {
      {"tolerance", &o.tolerance, {0.0005, 0.1}, "", "Depths that differ by a smaller share agree"},
      {"least_agreeing", &o.least_agreeing, {1, 16}, "", "Other maps that must agree with a pixel"},
      {"least_uncontested", &o.least_uncontested, {0, 16}, "", "The same where no map has another depth"},
      {"passes", &o.passes, {1, 4}, "", "Times that the maps are checked, each with what the last one kept"},
      {"most_through",
       &o.most_through,
       {0, 16},
       "",
       "Other maps that may see something farther through a pixel, for each that agrees"},
      {"least_patch", &o.least_patch, {0, 0.01}, "", "Share of the picture that a surface must cover"}};
}

Result<std::vector<PosedDepthMap>> consistent_depth(std::span<const PosedDepthMap> maps,
                                                    const ConsistencyOptions& options, const Work& work) {
  if (auto checked = check_ranges(options); !checked) return checked.error();
  std::vector<PosedDepthMap> out(maps.begin(), maps.end());
  for (int pass = 0; pass < options.passes; ++pass) {
    const std::vector<PosedDepthMap> before = pass == 0 ? std::vector<PosedDepthMap>{} : out;
    const std::span<const PosedDepthMap> evidence = pass == 0 ? maps : std::span(before);
    for (std::size_t self = 0; self < maps.size(); ++self) {
      if (work.cancelled()) return Work::interrupted();
      keep_agreed(evidence, self, options, out[self].depth.depth_m, work);
    }
  }
  return out;
}

}  // namespace palpable::vision
