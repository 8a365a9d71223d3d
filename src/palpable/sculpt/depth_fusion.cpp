// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/depth_fusion.hpp"

#include "palpable/sculpt/box.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace palpable::sculpt {
namespace {

constexpr int kSide = LevelSet::kSide;

/// One map, and how a place of the scene is found in it.
struct Sight {
  const DepthMap* map = nullptr;
  Transform<CameraFrame, SceneFrame> camera_from_scene;
};

bool counts(float depth_m, const FusionOptions& options) {
  const double z = static_cast<double>(depth_m);
  return z > 0.0 && z >= options.near_m && z <= options.far_m;
}

Result<void> check(std::span<const DepthView> views, const FusionOptions& options) {
  if (options.resolution < 16 || options.resolution > 512)
    return Error{ErrorCode::usage, "depth is fused in 16 to 512 voxels along the longest side", {}};
  if (!(options.truncation_voxels >= 1.0 && options.truncation_voxels <= 64.0))
    return Error{ErrorCode::usage, "distances are truncated at 1 to 64 voxels", {}};
  for (const DepthView& view : views) {
    if (view.depth == nullptr || !view.depth->camera)
      return invalid_input("states no camera, without which its depth has no width: give --calibration");
    if (view.depth->depth_m.width() != view.depth->camera->width ||
        view.depth->depth_m.height() != view.depth->camera->height)
      return invalid_input("has another size than its camera");
  }
  return {};
}

/// Around all places that were seen.
std::optional<Box> seen_box(std::span<const DepthView> views, const FusionOptions& options) {
  std::optional<Box> box;
  for (const DepthView& view : views) {
    const Pinhole& camera = *view.depth->camera;
    for (int y = 0; y < camera.height; ++y)
      for (int x = 0; x < camera.width; ++x) {
        const float depth = view.depth->depth_m(x, y);
        if (!counts(depth, options)) continue;
        const double z = static_cast<double>(depth);
        const Point<CameraFrame> c{{z * (x - camera.cx) / camera.fx, z * (y - camera.cy) / camera.fy, z}};
        const Vec3 p = (view.scene_from_camera * c).v;
        if (!box) box = Box{p, p};
        box->grow(p);
      }
  }
  return box;
}

/// What the maps say of one place.
class Voices {
 public:
  Voices(const FusionOptions& options, double truncation_m, double fill_m)
      : options_(options), truncation_m_(truncation_m), fill_m_(fill_m) {}

  void ask(const Sight& sight, Vec3 p) {
    const Pinhole& camera = *sight.map->camera;
    const Vec3 c = (sight.camera_from_scene * Point<SceneFrame>{p}).v;
    if (!(c.z > 0.0)) return;
    const double right = c.x / c.z, down = c.y / c.z;
    const double u = std::round(camera.fx * right + camera.cx), v = std::round(camera.fy * down + camera.cy);
    if (!(u >= 1.0 && v >= 1.0 && u < camera.width - 1.0 && v < camera.height - 1.0)) return;
    const Raster<float>& depth = sight.map->depth_m;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const float here = depth(x, y);
    if (!counts(here, options_)) return;
    const double along_m = (static_cast<double>(here) - c.z) * std::sqrt(1.0 + right * right + down * down);
    if (along_m < -truncation_m_) {
      ++behind_;
      near_behind_ = near_behind_ || along_m > -fill_m_;
      return;
    }
    // At a step the depth of one side may stand on the other.
    for (const float beside : {depth(x - 1, y), depth(x + 1, y), depth(x, y - 1), depth(x, y + 1)})
      if (!(std::abs(beside - here) < static_cast<float>(truncation_m_))) return;
    sum_m_ += std::min(along_m, truncation_m_);
    ++told_;
  }

  float value(std::size_t maps) const {
    if (told_ > 0) return static_cast<float>(sum_m_ / told_);
    const bool solid = near_behind_ || 2 * behind_ > maps;
    return static_cast<float>(solid ? -truncation_m_ : truncation_m_);
  }

 private:
  const FusionOptions& options_;
  double truncation_m_;
  double fill_m_;
  double sum_m_ = 0.0;
  int told_ = 0;
  std::size_t behind_ = 0;
  bool near_behind_ = false;
};

}  // namespace

Result<LevelSet> fused_depth(std::span<const DepthView> views, const FusionOptions& options,
                             const Work& work) {
  if (const auto sound = check(views, options); !sound) return sound.error();
  const auto box = seen_box(views, options);
  if (!box) return invalid_input("holds no depth that counts, and neither do the others");
  const Vec3 size = box->size_m();
  const double voxel_m = std::max({size.x, size.y, size.z}) / options.resolution;
  if (!(voxel_m > 0.0 && voxel_m < 1e3)) return invalid_input("holds depths of no finite extent");
  const double truncation_m = options.truncation_voxels * voxel_m;
  const double fill_m = options.fill_share * options.resolution * voxel_m;
  std::vector<Sight> sights;
  for (const DepthView& view : views) sights.push_back({view.depth, view.scene_from_camera.inverse()});

  LevelSet set;
  set.background = static_cast<float>(truncation_m);
  set.steps_m = {Vec3{voxel_m, 0.0, 0.0}, Vec3{0.0, voxel_m, 0.0}, Vec3{0.0, 0.0, voxel_m}};
  const double margin_m = (options.truncation_voxels + 2.0) * voxel_m;
  set.origin_m = box->least_m - Vec3{margin_m, margin_m, margin_m};
  const auto blocks = [&](double extent) {
    return static_cast<int>(std::ceil((extent + 2.0 * margin_m) / voxel_m / kSide)) + 1;
  };
  const std::array<int, 3> count{blocks(size.x), blocks(size.y), blocks(size.z)};
  const auto index = [&](int i, int j, int k) {
    return static_cast<std::size_t>((k * count[1] + j) * count[0] + i);
  };
  std::vector<LevelSet::Block> all(index(0, 0, count[2]));
  // One for each block; a byte, since threads write them beside each other.
  std::vector<std::uint8_t> solid(all.size());
  std::atomic<int> done{0};
  parallel_for(work, count[2], 1, [&](int begin, int end) {
    for (int k = begin; k < end && !work.cancelled(); ++k) {
      for (int j = 0; j < count[1]; ++j)
        for (int i = 0; i < count[0]; ++i) {
          LevelSet::Block& block = all[index(i, j, k)];
          block.corner = {kSide * i, kSide * j, kSide * k};
          for (std::size_t at = 0; at < block.values.size(); ++at) {
            const int n = static_cast<int>(at);
            const int x = n / (kSide * kSide), y = n / kSide % kSide, z = n % kSide;
            const Vec3 p = set.origin_m + voxel_m * Vec3{1.0 * block.corner[0] + x, 1.0 * block.corner[1] + y,
                                                         1.0 * block.corner[2] + z};
            Voices voices(options, truncation_m, fill_m);
            // What is filled behind ends a little beyond what was seen.
            const auto in_side = [&](double v, double least_m, double most_m) {
              return v >= least_m - truncation_m && v <= most_m + truncation_m;
            };
            const bool in = in_side(p.x, box->least_m.x, box->most_m.x) &&
                            in_side(p.y, box->least_m.y, box->most_m.y) &&
                            in_side(p.z, box->least_m.z, box->most_m.z);
            if (in)
              for (const Sight& sight : sights) voices.ask(sight, p);
            block.values[at] = voices.value(sights.size());
            if (block.values[at] < 0.0F) solid[index(i, j, k)] = 1;
          }
        }
      work.report(static_cast<double>(++done) / count[2], "fusing the depth maps");
    }
  });
  if (work.cancelled()) return Work::interrupted();
  // With their neighbours, so that the surface lies in blocks on both its sides.
  const auto near_solid = [&](int i, int j, int k) {
    for (int z = std::max(0, k - 1); z <= std::min(count[2] - 1, k + 1); ++z)
      for (int y = std::max(0, j - 1); y <= std::min(count[1] - 1, j + 1); ++y)
        for (int x = std::max(0, i - 1); x <= std::min(count[0] - 1, i + 1); ++x)
          if (solid[index(x, y, z)] != 0) return true;
    return false;
  };
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i)
        if (near_solid(i, j, k)) set.blocks.push_back(all[index(i, j, k)]);
  return set;
}

}  // namespace palpable::sculpt
