// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/surface_map.hpp"

#include "palpable/core/check.hpp"
#include "palpable/vision/mapping/pixel_planes.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace palpable::vision {
namespace {

constexpr double kTick_s = 0.1;
/// A share of the truncation of 1.
constexpr float kOne = 32767.0F;
/// The noise of a reading of confidence 1, m, and the greatest confidence of one.
constexpr float kPoor_m = 0.03F;
constexpr float kMostConfident = 1000.0F;
/// A surface seen nearly along its edge: its readings say little about its distance.
constexpr float kLeastFacing = 0.15F;

std::uint16_t tick_of(double time_s) {
  return static_cast<std::uint16_t>(static_cast<std::uint64_t>(time_s / kTick_s) & 0xFFFFU);
}

int block_of(double x_m, double block_m) { return static_cast<int>(std::floor(x_m / block_m)); }

}  // namespace

/// A picture that is being fused.
struct SurfaceMap::Frame {
  const PosedDepth& posed;
  Raster<PixelPlane> planes;
  Transform<CameraFrame, WorldFrame> camera_from_world;
  float farthest_m = 0.0F;
};

Result<void> check(const SurfaceMapOptions& o) {
  const auto usage = [](const char* message) { return Error{ErrorCode::usage, message, {}}; };
  if (!(o.voxel_m >= 0.001 && o.voxel_m <= 0.5)) return usage("a map's voxels have sides of 0.001 to 0.5 m");
  if (!(o.truncation_voxels >= 2.0 && o.truncation_voxels <= 8.0))
    return usage("a map's distances are known up to 2 to 8 voxels");
  if (!(o.most_readings >= 1.0 && o.most_readings <= 200.0))
    return usage("a map's voxel is the mean of at most 1 to 200 readings");
  if (o.most_blocks < 64 || o.most_blocks > 1'000'000)
    return usage("a map has at most 64 to 1 000 000 blocks");
  if (!(o.forget_s >= 1.0 && o.forget_s <= 3600.0)) return usage("a map forgets after 1 to 3600 s");
  if (!(o.far_m >= 0.1 && o.far_m <= 100.0)) return usage("a map takes depths up to 0.1 to 100 m");
  return check(o.noise);
}

SurfaceMap::SurfaceMap(const SurfaceMapOptions& options) : options_(options) {
  PALPABLE_CHECK(check(options).has_value());
  distance_scale_m_ = static_cast<float>(truncation_m()) / kOne;
}

std::uint16_t SurfaceMap::age(const Block& block) const {
  return static_cast<std::uint16_t>(tick_of(now_s_) - block.seen);
}

double SurfaceMap::seen_s(std::uint16_t tick) const {
  return std::max(0.0, now_s_ - kTick_s * static_cast<std::uint16_t>(tick_of(now_s_) - tick));
}

void SurfaceMap::add(const PosedDepth& frame, double time_s) {
  PALPABLE_CHECK(frame.depth_m.width() == frame.camera.width &&
                 frame.depth_m.height() == frame.camera.height);
  now_s_ = std::max(now_s_, time_s);
  Frame fused{frame, pixel_planes(frame.depth_m, frame.camera), frame.world_from_camera.inverse(), 0.0F};
  for (const float z : frame.depth_m.values())
    if (z > fused.farthest_m && z <= options_.far_m) fused.farthest_m = z;
  if (!(fused.farthest_m > 0.0F)) return;
  allocate(fused);
  fuse(fused);
  constexpr double kPeriod_s = 1.0;
  if (now_s_ - forgot_s_ > kPeriod_s) forget();
}

/// Blocks along each line of sight, as far before and behind its surface as distances are kept.
void SurfaceMap::allocate(const Frame& frame) {
  const auto& [depth_m, camera, pose] = frame.posed;
  // Neighbouring readings are much nearer to each other than a block's side.
  constexpr int kStep_px = 2;
  const auto step = static_cast<float>(0.4 * block_m());
  BlockPlace last{1 << 19, 0, 0};
  for (int y = 0; y < depth_m.height(); y += kStep_px)
    for (int x = 0; x < depth_m.width(); x += kStep_px) {
      const float z = depth_m(x, y);
      if (!(z <= options_.far_m) || !(frame.planes(x, y).facing > kLeastFacing)) continue;
      const Vec3 ray = pose.rotate({(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0});
      const float band = static_cast<float>(truncation_m()) / frame.planes(x, y).facing;
      for (float at = std::max(0.01F, z - band); at < z + band + step; at += step) {
        const Vec3 p = pose.translation_m + std::min(at, z + band) * ray;
        const BlockPlace place{block_of(p.x, block_m()), block_of(p.y, block_m()), block_of(p.z, block_m())};
        if (place != last) require(place);
        last = place;
      }
    }
}

void SurfaceMap::require(BlockPlace place) {
  // Places beyond what the index holds are 160 km away with the default voxels.
  constexpr int kMost = 1 << 19;
  if (std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)}) >= kMost || has_block(place))
    return;
  if (blocks_.size() >= options_.most_blocks) {
    // A sixteenth of the blocks go at once, those that were not seen for the longest time.
    std::vector<std::uint16_t> ages;
    for (const Block& block : blocks_) ages.push_back(age(block));
    const auto rank = ages.begin() + static_cast<std::ptrdiff_t>(ages.size() / 16);
    std::nth_element(ages.begin(), rank, ages.end(), std::greater<>());
    std::size_t excess = ages.size() / 16 + 1;
    keep_blocks([&, oldest = *rank](const Block& block) {
      if (excess == 0 || age(block) < oldest) return true;
      --excess;
      return false;
    });
  }
  if (blocks_.capacity() == blocks_.size())
    blocks_.reserve(std::min(options_.most_blocks, 2 * blocks_.size() + 64));
  index_.insert(place, static_cast<std::int32_t>(blocks_.size()));
  blocks_.emplace_back();
  blocks_.back().place = place;
  blocks_.back().seen = tick_of(now_s_);
}

void SurfaceMap::fuse(const Frame& frame) {
  const double half_m = 0.5 * block_m();
  const double radius_m = half_m * std::sqrt(3.0);
  const Pinhole& camera = frame.posed.camera;
  const double wide = std::hypot(1.0, (std::max(camera.cx, camera.width - camera.cx) + 1.0) / camera.fx);
  const double high = std::hypot(1.0, (std::max(camera.cy, camera.height - camera.cy) + 1.0) / camera.fy);
  for (Block& block : blocks_) {
    const Vec3 centre = block_m() * Vec3{block.place.x + 0.5, block.place.y + 0.5, block.place.z + 0.5};
    const Vec3 p = (frame.camera_from_world * Point<WorldFrame>{centre}).v;
    if (p.z < -radius_m || p.z - radius_m > frame.farthest_m + truncation_m()) continue;
    // Outside of a side plane of the view by more than the block's radius.
    const double left = (p.x * camera.fx + p.z * (camera.cx + 1.0)) / camera.fx;
    const double right = (-p.x * camera.fx + p.z * (camera.width - camera.cx)) / camera.fx;
    const double top = (p.y * camera.fy + p.z * (camera.cy + 1.0)) / camera.fy;
    const double bottom = (-p.y * camera.fy + p.z * (camera.height - camera.cy)) / camera.fy;
    if (std::min(left, right) < -radius_m * wide || std::min(top, bottom) < -radius_m * high) continue;
    fuse(block, frame);
  }
}

void SurfaceMap::fuse(Block& block, const Frame& frame) const {
  const Pinhole& camera = frame.posed.camera;
  const auto fx = static_cast<float>(camera.fx), fy = static_cast<float>(camera.fy);
  const auto cx = static_cast<float>(camera.cx) + 0.5F, cy = static_cast<float>(camera.cy) + 0.5F;
  const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
  const auto truncation = static_cast<float>(truncation_m());
  const auto far_m = static_cast<float>(options_.far_m);
  const auto& r = frame.camera_from_world.rotation;
  const Vec3 corner = block_m() * Vec3{static_cast<double>(block.place.x), static_cast<double>(block.place.y),
                                       static_cast<double>(block.place.z)};
  const Vec3 first = (frame.camera_from_world * Point<WorldFrame>{corner}).v;
  const auto step = [&](std::size_t axis) {
    return std::array<float, 3>{static_cast<float>(r[axis] * options_.voxel_m),
                                static_cast<float>(r[axis + 3] * options_.voxel_m),
                                static_cast<float>(r[axis + 6] * options_.voxel_m)};
  };
  const auto dx = step(0), dy = step(1), dz = step(2);
  const std::uint16_t now = tick_of(now_s_);
  for (int k = 0; k < kSide; ++k)
    for (int j = 0; j < kSide; ++j) {
      const auto fj = static_cast<float>(j), fk = static_cast<float>(k);
      const float ox = static_cast<float>(first.x) + fj * dy[0] + fk * dz[0];
      const float oy = static_cast<float>(first.y) + fj * dy[1] + fk * dz[1];
      const float oz = static_cast<float>(first.z) + fj * dy[2] + fk * dz[2];
      for (int i = 0; i < kSide; ++i) {
        const auto fi = static_cast<float>(i);
        const float z = oz + fi * dx[2];
        if (!(z > 0.01F)) continue;
        const float u = fx * (ox + fi * dx[0]) / z + cx;
        const float v = fy * (oy + fi * dx[1]) / z + cy;
        if (!(u >= 0.0F && v >= 0.0F && u < width && v < height)) continue;
        const int x = static_cast<int>(u), y = static_cast<int>(v);
        const PixelPlane& plane = frame.planes(x, y);
        const float facing = plane.facing;
        if (!(facing > kLeastFacing)) continue;
        // The plane's depth on the voxel's own ray, within the pixel.
        const float inverse = plane.inverse + (u - 0.5F - static_cast<float>(x)) * plane.by_x +
                              (v - 0.5F - static_cast<float>(y)) * plane.by_y;
        if (!(inverse * far_m >= 1.0F)) continue;
        const float depth = 1.0F / inverse;
        const float beyond = (depth - z) * facing;
        if (beyond < -truncation) continue;
        const auto at = static_cast<std::size_t>((k * kSide + j) * kSide + i);
        std::uint16_t& weight = block.weight[at];
        const bool is_free = beyond >= truncation;
        // Free space is only of interest where there was a surface.
        if (is_free && weight == 0) continue;
        const float noise = options_.noise.deviation_m(depth) * facing;
        float confidence = std::min(kMostConfident, (kPoor_m / noise) * (kPoor_m / noise));
        // What lies behind a surface is less certain the farther behind it is: thin things have two sides.
        if (beyond < 0.0F) confidence *= 1.0F + beyond / truncation;
        confidence = std::max(1.0F, confidence);
        const float reading = std::min(1.0F, beyond / truncation);
        const float before = static_cast<float>(block.distance[at]) / kOne;
        auto w = static_cast<float>(weight);
        // What contradicts the map was moved, or was never there: the map soon believes it.
        if (w > 0.0F && std::abs(reading - before) > std::max(0.5F, 3.0F * noise / truncation)) w *= 0.5F;
        const float after = (w * before + confidence * reading) / (w + confidence);
        block.distance[at] = static_cast<std::int16_t>(std::lround(after * kOne));
        const float most = static_cast<float>(options_.most_readings) * confidence;
        weight = static_cast<std::uint16_t>(std::min(65535.0F, std::max(w, std::min(w + confidence, most))));
        if (!is_free) block.time[at] = block.seen = now;
      }
    }
}

/// Removes blocks that were not seen for long.
void SurfaceMap::forget() {
  forgot_s_ = now_s_;
  const auto most = static_cast<std::uint16_t>(options_.forget_s / kTick_s);
  if (std::any_of(blocks_.begin(), blocks_.end(), [&](const Block& b) { return age(b) > most; }))
    keep_blocks([&](const Block& b) { return age(b) <= most; });
}

template <class Keep>
void SurfaceMap::keep_blocks(const Keep& keep) {
  std::erase_if(blocks_, [&](const Block& block) { return !keep(block); });
  index_ = BlockIndex();
  for (std::size_t k = 0; k < blocks_.size(); ++k)
    index_.insert(blocks_[k].place, static_cast<std::int32_t>(k));
}

}  // namespace palpable::vision
