// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/field/level_set_surface.hpp"

#include "palpable/sculpt/triangles/dual_contour.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

constexpr int kSide = LevelSet::kSide;
constexpr std::size_t kMostCrossed = 10'000'000;

/// A level set in its own lattice coordinates, interpolated anywhere.
class Sampler {
 public:
  explicit Sampler(const LevelSet& set) : set_(set) {
    block_at_.reserve(set.blocks.size());
    for (std::uint32_t i = 0; i < set.blocks.size(); ++i) block_at_.emplace(key(set.blocks[i].corner), i);
    for (const LevelSet::Block& block : set.blocks) note_inside(block);
  }

  float value(std::array<int, 3> place) const {
    const std::array<int, 3> within{place[0] & (kSide - 1), place[1] & (kSide - 1), place[2] & (kSide - 1)};
    const std::uint64_t block = key({place[0] - within[0], place[1] - within[1], place[2] - within[2]});
    const auto at = block_at_.find(block);
    if (at == block_at_.end()) return inside_.contains(block) ? -set_.background : set_.background;
    return set_.blocks[at->second]
        .values[static_cast<std::size_t>((within[0] * kSide + within[1]) * kSide + within[2])];
  }

  double at(Vec3 p) const {
    const std::array<int, 3> low{floor(p.x), floor(p.y), floor(p.z)};
    const Vec3 f = p - Vec3{1.0 * low[0], 1.0 * low[1], 1.0 * low[2]};
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
      const int x = k & 1, y = k >> 1 & 1, z = k >> 2;
      const double share =
          (x != 0 ? f.x : 1.0 - f.x) * (y != 0 ? f.y : 1.0 - f.y) * (z != 0 ? f.z : 1.0 - f.z);
      if (share > 0.0) sum += share * static_cast<double>(value({low[0] + x, low[1] + y, low[2] + z}));
    }
    return sum;
  }

  /// Without a gradient: a grid has rounded its edges already, so gradients could only fold the surface.
  models::DistanceSample sample(Vec3 p) const { return {at(p), {}}; }

 private:
  /// There is no surface where there is no block: points there get the sign of the nearest sample of an
  /// adjacent block.
  void note_inside(const LevelSet::Block& block) {
    for (int x = -1; x <= 1; ++x)
      for (int y = -1; y <= 1; ++y)
        for (int z = -1; z <= 1; ++z) {
          const auto nearest = [](int side) { return side < 0 ? 0 : side > 0 ? kSide - 1 : kSide / 2; };
          const int at = (nearest(x) * kSide + nearest(y)) * kSide + nearest(z);
          if (!(block.values[static_cast<std::size_t>(at)] < 0.0F)) continue;
          const std::uint64_t beside =
              key({block.corner[0] + x * kSide, block.corner[1] + y * kSide, block.corner[2] + z * kSide});
          if (!block_at_.contains(beside)) inside_.insert(beside);
        }
  }
  static int floor(double x) { return static_cast<int>(std::floor(x)); }
  /// Corners are within 2^28 and multiples of 8.
  static std::uint64_t key(std::array<int, 3> corner) {
    const auto bits = [](int c) { return static_cast<std::uint64_t>(c / kSide) & 0x1FFFFFU; };
    return (bits(corner[0]) << 42U) | (bits(corner[1]) << 21U) | bits(corner[2]);
  }

  const LevelSet& set_;
  std::unordered_map<std::uint64_t, std::uint32_t> block_at_;
  std::unordered_set<std::uint64_t> inside_;
};

/// Points near the surface: one in every eighth of a block that the surface crosses. `crossed` counts the
/// crossed voxels; the search ends if there are too many.
std::vector<Vec3> seeds_of(const LevelSet& set, const Sampler& sampler, std::size_t& crossed) {
  std::vector<Vec3> seeds;
  for (const LevelSet::Block& block : set.blocks) {
    unsigned seeded = 0;
    for (int i = 0; i < kSide * kSide * kSide; ++i) {
      const std::array<int, 3> in{i / (kSide * kSide), i / kSide % kSide, i % kSide};
      const std::array<int, 3> p{block.corner[0] + in[0], block.corner[1] + in[1], block.corner[2] + in[2]};
      const bool inside = sampler.value(p) < 0.0F;
      bool crosses = false;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        std::array<int, 3> next = p;
        ++next[axis];
        crosses = crosses || (sampler.value(next) < 0.0F) != inside;
      }
      if (!crosses) continue;
      ++crossed;
      const unsigned eighth = 1U << static_cast<unsigned>((in[0] / 4) * 4 + (in[1] / 4) * 2 + in[2] / 4);
      if ((seeded & eighth) != 0) continue;
      seeded |= eighth;
      seeds.push_back({p[0] + 0.5, p[1] + 0.5, p[2] + 0.5});
    }
    if (crossed > kMostCrossed) break;
  }
  return seeds;
}

}  // namespace

Result<Mesh> surface_of_level_set(const LevelSet& set, const Work& work) {
  if (set.blocks.empty()) return invalid_input("is a level set without a surface");
  const Sampler sampler(set);
  std::size_t crossed = 0;
  const auto seeds = seeds_of(set, sampler, crossed);
  if (crossed > kMostCrossed)
    return invalid_input("is a level set whose surface passes over 10 million voxels: take larger voxels");
  const auto& first = set.blocks.front().corner;
  Box box{{1.0 * first[0], 1.0 * first[1], 1.0 * first[2]}, {1.0 * first[0], 1.0 * first[1], 1.0 * first[2]}};
  for (const LevelSet::Block& block : set.blocks) {
    const Vec3 corner{1.0 * block.corner[0], 1.0 * block.corner[1], 1.0 * block.corner[2]};
    box.grow(corner - Vec3{1.0, 1.0, 1.0});
    box.grow(corner + Vec3{kSide + 1.0, kSide + 1.0, kSide + 1.0});
  }
  constexpr double kMostVoxels = 1 << 19;
  const Vec3 size = box.size_m();
  if (std::max({size.x, size.y, size.z}) > kMostVoxels)
    return invalid_input("is a level set over 2^19 voxels long");
  auto mesh = dual_contour([&](Vec3 p) { return sampler.sample(p); }, box, seeds, {1.0}, work);
  if (!mesh) return mesh.error();
  if (mesh->triangles.empty()) return invalid_input("is a level set without a surface");
  const auto& steps = set.steps_m;
  for (Vec3& v : mesh->vertices_m) v = set.origin_m + v.x * steps[0] + v.y * steps[1] + v.z * steps[2];
  if (dot(steps[0], cross(steps[1], steps[2])) < 0.0)
    for (auto& t : mesh->triangles) std::swap(t[1], t[2]);
  return mesh;
}

}  // namespace palpable::sculpt
