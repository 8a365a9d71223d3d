// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/depth_fusion.hpp"

#include "palpable/sculpt/triangles/box.hpp"

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

/// A depth map with its camera's pose.
struct PosedMap {
  const DepthMap* depth = nullptr;
  Transform<CameraFrame, SceneFrame> camera_from_scene;
  Vec3 position_m;

  /// Whether the line of sight of a point falls by so much per horizontal length; 0: in every direction.
  bool falls(Vec3 p, double least_fall) const {
    const Vec3 along = p - position_m;
    return least_fall == 0.0 || -along.z >= least_fall * std::hypot(along.x, along.y);
  }
};

bool counts(float depth_m, const FusionOptions& options) {
  const double z = static_cast<double>(depth_m);
  return z > 0.0 && z >= options.near_m && z <= options.far_m;
}

Result<void> check(std::span<const DepthView> views, const FusionOptions& options) {
  if (auto valid = check_ranges(options); !valid) return valid;
  for (const DepthView& view : views) {
    if (view.depth == nullptr || !view.depth->camera)
      return invalid_input("states no camera, which is needed to compute sizes from depth", {},
                           Reason::needs_calibration);
    if (view.depth->depth_m.width() != view.depth->camera->width ||
        view.depth->depth_m.height() != view.depth->camera->height)
      return invalid_input("has another size than its camera");
  }
  return {};
}

/// The bounding box of all seen points.
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

/// Accumulates what the maps measure at one voxel.
class VoxelAccumulator {
 public:
  VoxelAccumulator(const FusionOptions& options, double truncation_m, double fill_m)
      : options_(options),
        truncation_m_(truncation_m),
        fill_m_(fill_m),
        least_fall_(options.unseen == Unseen::solid_below_surfaces ? options.least_fall : 0.0) {}

  void add(const PosedMap& map, Vec3 p) {
    const Pinhole& camera = *map.depth->camera;
    const Vec3 c = (map.camera_from_scene * Point<SceneFrame>{p}).v;
    if (!(c.z > 0.0)) return;
    const double right = c.x / c.z, down = c.y / c.z;
    const double u = std::round(camera.fx * right + camera.cx), v = std::round(camera.fy * down + camera.cy);
    if (!(u >= 1.0 && v >= 1.0 && u < camera.width - 1.0 && v < camera.height - 1.0)) return;
    const Raster<float>& depth = map.depth->depth_m;
    const int x = static_cast<int>(u), y = static_cast<int>(v);
    const float here = depth(x, y);
    if (!counts(here, options_)) return;
    const double along_m = (static_cast<double>(here) - c.z) * std::sqrt(1.0 + right * right + down * down);
    if (along_m < -truncation_m_) {
      behind_ += map.falls(p, least_fall_) ? 1U : 0U;
      near_behind_ = near_behind_ || along_m > -fill_m_;
      return;
    }
    // At a depth discontinuity a pixel may have the depth of the other side.
    for (const float neighbour : {depth(x - 1, y), depth(x + 1, y), depth(x, y - 1), depth(x, y + 1)})
      if (!(std::abs(neighbour - here) < static_cast<float>(truncation_m_))) return;
    const double distance_m = std::min(along_m, truncation_m_);
    sum_m_ += distance_m;
    squares_m2_ += distance_m * distance_m;
    ++measured_;
  }

  bool measured() const { return measured_ > 0; }
  float value(std::size_t maps) const {
    if (measured()) return static_cast<float>(sum_m_ / measured_);
    const bool solid = near_behind_ || 2 * behind_ > maps;
    return static_cast<float>(solid ? -truncation_m_ : truncation_m_);
  }
  /// The variance of that value; negative if fewer than two maps measured it.
  float variance_m2() const {
    if (measured_ < 2) return -1.0F;
    const double mean_m = sum_m_ / measured_;
    const double of_one_m2 = std::max(0.0, squares_m2_ / measured_ - mean_m * mean_m);
    return static_cast<float>(of_one_m2 / (measured_ - 1));
  }

 private:
  const FusionOptions& options_;
  double truncation_m_;
  double fill_m_;
  double least_fall_;
  double sum_m_ = 0.0;
  double squares_m2_ = 0.0;
  int measured_ = 0;
  std::size_t behind_ = 0;
  bool near_behind_ = false;
};

/// Makes voxels of a column that no map measured solid below a surface. `measured`: for each voxel of the
/// column, upwards, which begins at `column`.
void fill_below_surfaces(const std::vector<bool>& measured, float truncation_m, float* column) {
  bool below_surface = false;
  for (std::size_t z = measured.size(); z-- > 0;) {
    if (column[z] < 0.0F) below_surface = true;
    if (measured[z] && column[z] >= 0.0F) below_surface = false;
    if (!measured[z] && below_surface) column[z] = -truncation_m;
  }
}

/// Blocks that contain solid voxels, and their neighbours, so that blocks cover both sides of the surface.
std::vector<LevelSet::Block> blocks_of(const FusedDistances& fused, const std::array<int, 3>& count) {
  const auto index = [&](int i, int j, int k) {
    return static_cast<std::size_t>((k * count[1] + j) * count[0] + i);
  };
  std::vector<bool> solid(index(0, 0, count[2]));
  for (int x = 0; x < fused.size[0]; ++x)
    for (int y = 0; y < fused.size[1]; ++y)
      for (int z = 0; z < fused.size[2]; ++z)
        if (fused.distance_m[fused.index(x, y, z)] < 0.0F)
          solid[index(x / kSide, y / kSide, z / kSide)] = true;
  const auto near_solid = [&](int i, int j, int k) {
    for (int z = std::max(0, k - 1); z <= std::min(count[2] - 1, k + 1); ++z)
      for (int y = std::max(0, j - 1); y <= std::min(count[1] - 1, j + 1); ++y)
        for (int x = std::max(0, i - 1); x <= std::min(count[0] - 1, i + 1); ++x)
          if (solid[index(x, y, z)]) return true;
    return false;
  };
  std::vector<LevelSet::Block> blocks;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        if (!near_solid(i, j, k)) continue;
        LevelSet::Block& block = blocks.emplace_back();
        block.corner = {kSide * i, kSide * j, kSide * k};
        for (int n = 0; n < kSide * kSide * kSide; ++n)
          block.values[static_cast<std::size_t>(n)] =
              fused.distance_m[fused.index(block.corner[0] + n / (kSide * kSide),
                                           block.corner[1] + n / kSide % kSide, block.corner[2] + n % kSide)];
      }
  return blocks;
}

}  // namespace

std::vector<Parameter> parameters_of(FusionOptions& o) {
  std::vector<Parameter> parameters{
      {"resolution", &o.resolution, {16, 512}, "voxels", "voxels along the longest side"},
      {"truncation_voxels", &o.truncation_voxels, {1.0, 64.0}, "voxels", "truncation of distances"},
      {"fill_share", &o.fill_share, {0.0, 1.0}, "", "depth behind a surface that one map fills"},
      {"least_fall",
       &o.least_fall,
       {0.0, 100.0},
       "",
       "fall of lines of sight per horizontal length, behind whose surfaces several maps fill; on a ground "
       "only"}};
  append_parameters(parameters, "smoothing", parameters_of(o.smoothing));
  return parameters;
}

Result<LevelSet> fused_depth(std::span<const DepthView> views, const FusionOptions& options,
                             const Work& work) {
  if (const auto valid = check(views, options); !valid) return valid.error();
  const auto box = seen_box(views, options);
  if (!box) return invalid_input("has no depth in the range from near to far, nor has any other map");
  const Vec3 size = box->size_m();
  const double voxel_m = std::max({size.x, size.y, size.z}) / options.resolution;
  if (!(voxel_m > 0.0 && voxel_m < 1e3)) return invalid_input("holds depths of no finite extent");
  const double truncation_m = options.truncation_voxels * voxel_m;
  const double fill_m = options.fill_share * options.resolution * voxel_m;
  std::vector<PosedMap> maps;
  for (const DepthView& view : views)
    maps.push_back({view.depth, view.scene_from_camera.inverse(), view.scene_from_camera.translation_m});

  LevelSet set;
  set.background = static_cast<float>(truncation_m);
  set.steps_m = {Vec3{voxel_m, 0.0, 0.0}, Vec3{0.0, voxel_m, 0.0}, Vec3{0.0, 0.0, voxel_m}};
  const double margin_m = (options.truncation_voxels + 2.0) * voxel_m;
  set.origin_m = box->least_m - Vec3{margin_m, margin_m, margin_m};
  const auto blocks = [&](double extent) {
    return static_cast<int>(std::ceil((extent + 2.0 * margin_m) / voxel_m / kSide)) + 1;
  };
  const std::array<int, 3> count{blocks(size.x), blocks(size.y), blocks(size.z)};
  FusedDistances fused;
  for (std::size_t axis = 0; axis < 3; ++axis) fused.size[axis] = kSide * count[axis];
  const std::size_t voxels = fused.index(fused.size[0], 0, 0);
  fused.distance_m.resize(voxels);
  fused.variance_m2.resize(voxels);
  std::atomic<int> done{0};
  // The filled volume ends a truncation distance beyond the seen points.
  const auto in_side = [&](double v, double least_m, double most_m) {
    return v >= least_m - truncation_m && v <= most_m + truncation_m;
  };
  parallel_for(work, fused.size[0], 1, [&](int begin, int end) {
    std::vector<bool> measured;
    for (int x = begin; x < end && !work.cancelled(); ++x) {
      for (int y = 0; y < fused.size[1]; ++y) {
        measured.clear();
        for (int z = 0; z < fused.size[2]; ++z) {
          const Vec3 p = set.origin_m + voxel_m * Vec3{1.0 * x, 1.0 * y, 1.0 * z};
          VoxelAccumulator voxel(options, truncation_m, fill_m);
          const bool inside = in_side(p.x, box->least_m.x, box->most_m.x) &&
                              in_side(p.y, box->least_m.y, box->most_m.y) &&
                              in_side(p.z, box->least_m.z, box->most_m.z);
          if (inside)
            for (const PosedMap& map : maps) voxel.add(map, p);
          fused.distance_m[fused.index(x, y, z)] = voxel.value(maps.size());
          fused.variance_m2[fused.index(x, y, z)] = voxel.variance_m2();
          // Beyond the seen volume there is nothing to fill.
          measured.push_back(!inside || voxel.measured());
        }
        if (options.unseen == Unseen::solid_below_surfaces)
          fill_below_surfaces(measured, static_cast<float>(truncation_m),
                              &fused.distance_m[fused.index(x, y, 0)]);
      }
      work.report(0.9 * static_cast<double>(++done) / fused.size[0], "fusing the depth maps");
    }
  });
  if (work.cancelled()) return Work::interrupted();
  work.report(0.9, "smoothing the remaining noise");
  smooth(fused, truncation_m, options.smoothing, work);
  if (work.cancelled()) return Work::interrupted();
  set.blocks = blocks_of(fused, count);
  return set;
}

}  // namespace palpable::sculpt
