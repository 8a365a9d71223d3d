// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"
#include "palpable/core/result.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"
#include "palpable/vision/mapping/block_index.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace palpable::vision {

/// A depth picture and where its camera was.
struct PosedDepth {
  /// Along the camera's z axis, metres; NaN = unknown.
  Raster<float> depth_m;
  Pinhole camera;
  /// Rigid (scale 1).
  Transform<WorldFrame, CameraFrame> world_from_camera;
};

/// The defaults were chosen on simulated rooms (docs/history).
struct SurfaceMapOptions {
  /// Side of a voxel, 0.001 … 0.5 m.
  double voxel_m = 0.02;
  /// Distances from a surface are known up to this many voxels, 2 … 8.
  double truncation_voxels = 3.0;
  /// Readings of the same quality that a voxel is the mean of at most, 1 … 200: how fast it follows.
  double most_readings = 30.0;
  /// The map has at most this many blocks of 8 x 8 x 8 voxels, 64 … 1 000 000; the longest unseen ones make
  /// room for new ones. The default is 71 MiB.
  std::size_t most_blocks = 24'000;
  /// What was not seen for this time is forgotten, 1 … 3600 s.
  double forget_s = 600.0;
  /// Depths beyond are ignored, 0.1 … 100 m.
  double far_m = 5.0;
  /// Of the depth that is added.
  DepthNoise noise;
};

/// Errors: usage for a value outside its range.
Result<void> check(const SurfaceMapOptions& options);

/// The map near a point.
struct MapSample {
  /// Signed distance from the nearest surface, truncated, m: positive on the side from which it was seen.
  double distance_m = 0.0;
  /// Its derivative by the position.
  Vec3 gradient;
};

/// A point of the mapped surface, for measures and pictures.
struct SurfacePoint {
  Vec3 position_m;
  /// When it was seen last, on the clock of SurfaceMap::add().
  double seen_s = 0.0;
};

/// Surfaces fused from posed depth pictures: truncated signed distances on sparse blocks of voxels (Curless &
/// Levoy 1996; blocks as Nießner et al. 2013). Each reading changes the voxels before and behind its surface;
/// those before it that held a surface are cleared, so that what has gone vanishes from the map when rays
/// pass through its place. Memory is bounded. One thread.
class SurfaceMap {
 public:
  static constexpr int kSide = 8;
  static constexpr int kVoxels = kSide * kSide * kSide;

  /// `options` within their ranges (check()).
  explicit SurfaceMap(const SurfaceMapOptions& options);

  /// Fuses a picture taken at `time_s` >= 0, which must not decrease by more than the clock's step of 0.1 s.
  void add(const PosedDepth& frame, double time_s);
  /// Trilinear between eight voxels; nullopt where one of them is unknown.
  std::optional<MapSample> sample(Point<WorldFrame> p) const;
  /// The distance alone, NaN if it is unknown; of the nearest voxel, and between eight.
  float nearest_m(Vec3 p) const;
  float distance_m(Vec3 p) const;
  /// When a voxel around the point was seen last; 0 if none was.
  double seen_s(Vec3 p) const;
  bool has_block(BlockPlace place) const { return index_.find(place) != BlockIndex::kNone; }
  /// Where the surface crosses the lines between neighbouring voxels.
  std::vector<SurfacePoint> surface() const;

  const SurfaceMapOptions& options() const { return options_; }
  double block_m() const { return kSide * options_.voxel_m; }
  double truncation_m() const { return options_.truncation_voxels * options_.voxel_m; }
  bool empty() const { return blocks_.empty(); }
  std::size_t bytes() const { return blocks_.capacity() * sizeof(Block) + index_.bytes(); }

 private:
  /// x innermost.
  struct Block {
    BlockPlace place;
    /// The latest of its voxels' times.
    std::uint16_t seen = 0;
    /// Distances as shares of the truncation, -kOne … kOne.
    std::array<std::int16_t, kVoxels> distance{};
    /// Confidence; 0 = unknown.
    std::array<std::uint16_t, kVoxels> weight{};
    /// Time of the last reading near the surface, in kTick_s, modulo 2^16.
    std::array<std::uint16_t, kVoxels> time{};
  };
  struct Frame;
  /// Distances at the eight voxels around a point, x innermost, and where it is between them.
  struct Corners {
    std::array<float, 8> value;
    float a, b, c;
  };

  void allocate(const Frame& frame);
  void require(BlockPlace place);
  void fuse(const Frame& frame);
  void fuse(Block& block, const Frame& frame) const;
  void forget();
  template <class Keep>
  void keep_blocks(const Keep& keep);
  std::uint16_t age(const Block& block) const;
  const Block* block_at(BlockPlace place) const {
    const std::int32_t number = index_.find(place);
    return number == BlockIndex::kNone ? nullptr : &blocks_[static_cast<std::size_t>(number)];
  }
  bool corners(Vec3 p, Corners& corners) const;
  double seen_s(std::uint16_t tick) const;

  SurfaceMapOptions options_;
  /// Metres of a stored distance of 1.
  float distance_scale_m_;
  std::vector<Block> blocks_;
  BlockIndex index_;
  /// The time of the last picture, and of the last search for what is forgotten.
  double now_s_ = 0.0;
  double forgot_s_ = 0.0;
};

}  // namespace palpable::vision
