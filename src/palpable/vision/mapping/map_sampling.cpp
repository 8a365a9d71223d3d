// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/surface_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::vision {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();

/// A voxel of the lattice whose points are the multiples of the voxel's side.
struct VoxelPlace {
  int x, y, z;

  BlockPlace block() const { return {x >> kShift, y >> kShift, z >> kShift}; }
  std::size_t in_block() const {
    constexpr int kMask = SurfaceMap::kSide - 1;
    return static_cast<std::size_t>(((z & kMask) * SurfaceMap::kSide + (y & kMask)) * SurfaceMap::kSide +
                                    (x & kMask));
  }

 private:
  static constexpr int kShift = 3;
};

VoxelPlace nearest_voxel(Vec3 p, double voxel_m) {
  return {static_cast<int>(std::lround(p.x / voxel_m)), static_cast<int>(std::lround(p.y / voxel_m)),
          static_cast<int>(std::lround(p.z / voxel_m))};
}

VoxelPlace voxel_before(Vec3 p, double voxel_m) {
  return {static_cast<int>(std::floor(p.x / voxel_m)), static_cast<int>(std::floor(p.y / voxel_m)),
          static_cast<int>(std::floor(p.z / voxel_m))};
}

}  // namespace

float SurfaceMap::nearest_m(Vec3 p) const {
  const VoxelPlace place = nearest_voxel(p, options_.voxel_m);
  const Block* block = block_at(place.block());
  if (block == nullptr || block->weight[place.in_block()] == 0) return kUnknown;
  return static_cast<float>(block->distance[place.in_block()]) * distance_scale_m_;
}

double SurfaceMap::seen_s(Vec3 p) const {
  const VoxelPlace first = voxel_before(p, options_.voxel_m);
  double latest_s = 0.0;
  for (int k = 0; k < 8; ++k) {
    const VoxelPlace place{first.x + (k & 1), first.y + (k >> 1 & 1), first.z + (k >> 2)};
    const Block* block = block_at(place.block());
    if (block != nullptr && block->weight[place.in_block()] > 0)
      latest_s = std::max(latest_s, seen_s(block->time[place.in_block()]));
  }
  return latest_s;
}

/// The eight voxels around a point; false if one is unknown.
bool SurfaceMap::corners(Vec3 p, Corners& c) const {
  const double x = p.x / options_.voxel_m, y = p.y / options_.voxel_m, z = p.z / options_.voxel_m;
  const VoxelPlace first = voxel_before(p, options_.voxel_m);
  c.a = static_cast<float>(x - first.x);
  c.b = static_cast<float>(y - first.y);
  c.c = static_cast<float>(z - first.z);
  const Block* block = nullptr;
  BlockPlace last{};
  for (int k = 0; k < 8; ++k) {
    const VoxelPlace place{first.x + (k & 1), first.y + (k >> 1 & 1), first.z + (k >> 2)};
    if (const BlockPlace at = place.block(); block == nullptr || at != last) {
      block = block_at(at);
      last = at;
      if (block == nullptr) return false;
    }
    const std::size_t in = place.in_block();
    if (block->weight[in] == 0) return false;
    c.value[static_cast<std::size_t>(k)] = static_cast<float>(block->distance[in]) * distance_scale_m_;
  }
  return true;
}

float SurfaceMap::distance_m(Vec3 p) const {
  Corners c;
  if (!corners(p, c)) return kUnknown;
  const auto& v = c.value;
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  return mix(mix(mix(v[0], v[1], c.a), mix(v[2], v[3], c.a), c.b),
             mix(mix(v[4], v[5], c.a), mix(v[6], v[7], c.a), c.b), c.c);
}

std::optional<MapSample> SurfaceMap::sample(Point<WorldFrame> p) const {
  Corners c;
  if (!corners(p.v, c)) return std::nullopt;
  const auto& v = c.value;
  const auto mix = [](float a, float b, float t) { return a + t * (b - a); };
  const auto plane = [&](float q0, float q1, float q2, float q3, float s, float t) {
    return mix(mix(q0, q1, s), mix(q2, q3, s), t);
  };
  const auto per_m = 1.0 / options_.voxel_m;
  MapSample sample;
  sample.distance_m =
      mix(plane(v[0], v[1], v[2], v[3], c.a, c.b), plane(v[4], v[5], v[6], v[7], c.a, c.b), c.c);
  sample.gradient = {per_m * plane(v[1] - v[0], v[3] - v[2], v[5] - v[4], v[7] - v[6], c.b, c.c),
                     per_m * plane(v[2] - v[0], v[3] - v[1], v[6] - v[4], v[7] - v[5], c.a, c.c),
                     per_m * plane(v[4] - v[0], v[5] - v[1], v[6] - v[2], v[7] - v[3], c.a, c.b)};
  return sample;
}

std::vector<SurfacePoint> SurfaceMap::surface() const {
  std::vector<SurfacePoint> points;
  const double side = options_.voxel_m;
  // A crossing between a fully free voxel and the back of a surface is no place where a surface was seen.
  const auto near_m = static_cast<float>(0.98 * truncation_m());
  for (const Block& block : blocks_)
    for (int n = 0; n < kVoxels; ++n) {
      const auto in = static_cast<std::size_t>(n);
      if (block.weight[in] == 0) continue;
      const VoxelPlace at{block.place.x * kSide + n % kSide, block.place.y * kSide + n / kSide % kSide,
                          block.place.z * kSide + n / (kSide * kSide)};
      const Vec3 p =
          side * Vec3{static_cast<double>(at.x), static_cast<double>(at.y), static_cast<double>(at.z)};
      const float here = static_cast<float>(block.distance[in]) * distance_scale_m_;
      for (const Vec3 axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
        const float there = nearest_m(p + side * axis);
        if (std::isnan(there) || (here > 0.0F) == (there > 0.0F) || std::max(here, there) > near_m) continue;
        points.push_back(
            {p + side * (here / static_cast<double>(here - there)) * axis, seen_s(block.time[in])});
      }
    }
  return points;
}

}  // namespace palpable::vision
