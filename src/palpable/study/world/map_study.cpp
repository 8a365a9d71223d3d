// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/map_study.hpp"

#include "palpable/vision/depth_camera/clean_depth.hpp"
#include "palpable/vision/mapping/map_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <numbers>
#include <unordered_map>

namespace palpable::study {
namespace {

using Pose = Transform<WorldFrame, CameraFrame>;

double processor_ms() { return 1000.0 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Points in cubic cells, to find those near a place.
class PointCells {
 public:
  explicit PointCells(double cell_m) : cell_m_(cell_m) {}

  void add(Vec3 p) { cells_[key(cell(p.x), cell(p.y), cell(p.z))].push_back(p); }
  /// Adds a point unless its cell has one.
  bool add_first(Vec3 p) {
    auto& points = cells_[key(cell(p.x), cell(p.y), cell(p.z))];
    if (points.empty()) points.push_back(p);
    return points.size() == 1;
  }
  /// Distance to the nearest point, if it is less than a cell's side; otherwise infinity.
  double nearest_m(Vec3 p) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 27; ++k) {
      const auto found =
          cells_.find(key(cell(p.x) + k % 3 - 1, cell(p.y) + k / 3 % 3 - 1, cell(p.z) + k / 9 - 1));
      if (found == cells_.end()) continue;
      for (const Vec3 q : found->second) nearest = std::min(nearest, squared_norm(p - q));
    }
    return std::sqrt(nearest);
  }
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const auto& [unused, points] : cells_)
      for (const Vec3 p : points) visit(p);
  }

 private:
  int cell(double x) const { return static_cast<int>(std::floor(x / cell_m_)); }
  static std::uint64_t key(int x, int y, int z) {
    const auto part = [](int v) { return static_cast<std::uint64_t>(v + (1 << 20)) & 0x1FFFFFU; };
    return part(x) << 42U | part(y) << 21U | part(z);
  }

  double cell_m_;
  std::unordered_map<std::uint64_t, std::vector<Vec3>> cells_;
};

/// The camera's pose while its robot is at `p`, `time_s` after the beginning.
Pose camera_on(const PlanarPose& p, double time_s, const MapStudyOptions& o) {
  const double sway = o.sway_rad * std::sin(2.0 * std::numbers::pi * time_s / o.sway_s);
  return camera_pose({{p.x_m, p.y_m, o.height_m}}, p.heading_rad + sway, o.down_rad);
}

/// The points that a view shows, into cells of 2 cm, as far as the map takes depths.
void add_seen(PointCells& seen, const RoomView& truth, const Pose& pose, const MapStudyOptions& o) {
  constexpr int kStep_px = 3;
  for (int y = 0; y < o.camera.height; y += kStep_px)
    for (int x = 0; x < o.camera.width; x += kStep_px) {
      const double z = truth.depth_m(x, y);
      if (!(z >= o.noise.near_m && z <= std::min(o.noise.far_m, o.memory.map.far_m))) continue;
      const Vec3 ray = pose.rotate({(x - o.camera.cx) / o.camera.fx, (y - o.camera.cy) / o.camera.fy, 1.0});
      seen.add_first(pose.translation_m + z * ray);
    }
}

/// Errors of the map's views of the room.
class DepthErrors {
 public:
  void add(const Raster<float>& map_m, const Raster<float>& truth_m, double far_m) {
    for (std::size_t k = 0; k < truth_m.count(); ++k) {
      const float truth = truth_m.values()[k];
      if (!(truth <= far_m)) continue;
      ++pixels_;
      low_ = std::min(low_, truth), high_ = std::max(high_, truth);
      const float z = map_m.values()[k];
      if (!std::isfinite(z)) continue;
      ++known_;
      squares_ += static_cast<double>(z - truth) * static_cast<double>(z - truth);
    }
  }
  double rms_percent() const {
    return 100.0 * std::sqrt(squares_ / known_) / static_cast<double>(high_ - low_);
  }
  double known() const { return known_ / pixels_; }

 private:
  double pixels_ = 0.0, known_ = 0.0, squares_ = 0.0;
  float low_ = 1e9F, high_ = 0.0F;
};

void score_surface(MapScore& score, const Room& room, const vision::SurfaceMap& map, const PointCells& seen) {
  PointCells mapped(0.041);
  double right_2cm = 0.0, right_4cm = 0.0, points = 0.0;
  for (const auto& p : map.surface()) {
    mapped.add(p.position_m);
    const double off = std::abs(distance_m(room, {p.position_m}));
    right_2cm += off <= 0.02, right_4cm += off <= 0.04, ++points;
  }
  double kept_2cm = 0.0, kept_4cm = 0.0, places = 0.0;
  seen.for_each([&](Vec3 p) {
    const double off = mapped.nearest_m(p);
    kept_2cm += off <= 0.02, kept_4cm += off <= 0.04, ++places;
  });
  score.right_2cm = right_2cm / points, score.right_4cm = right_4cm / points;
  score.kept_2cm = kept_2cm / places, score.kept_4cm = kept_4cm / places;
}

}  // namespace

std::optional<MapRun> run_map_study(std::uint64_t seed, const MapStudyOptions& options) {
  const Room room = make_room(seed);
  auto drive = drive_round(room, options.drive);
  if (drive.empty()) return std::nullopt;
  drive.resize(std::min(drive.size(), static_cast<std::size_t>(options.most_frames)));
  const auto odometry = odometry_of(drive, options.wheels, seed);
  auto memory_options = options.memory;
  if (options.motion == StatedMotion::exact) memory_options.motion = vision::Motion::exact;
  vision::CameraMemory memory(memory_options);
  PointCells seen(0.02);
  MapScore score;
  // Without stated poses the map's frame is the first camera's; it is measured in the room's.
  std::vector<Pose> poses;
  for (std::size_t k = 0; k < drive.size(); ++k) {
    const double time_s = static_cast<double>(k) / options.drive.rate_hz;
    const Pose pose = camera_on(drive[k], time_s, options);
    auto noise = options.noise;
    noise.seed = seed * 100'003 + k;
    add_seen(seen, render(room, pose, options.camera), pose, options);
    const auto& map_noise = memory_options.map.noise;
    const auto depth = vision::clean_depth(render(room, pose, options.camera, noise).depth_m, map_noise);
    std::optional<Pose> stated = pose;
    if (options.motion == StatedMotion::odometry) stated = camera_on(odometry[k], time_s, options);
    if (options.motion == StatedMotion::none && k > 0) stated.reset();
    const double before_ms = processor_ms();
    const auto found = memory.locate(depth, options.camera, stated);
    const double located_ms = processor_ms();
    if (found) memory.add(depth, options.camera, *found, time_s);
    score.locate_ms += located_ms - before_ms;
    score.add_ms += processor_ms() - located_ms;
    poses.push_back(found.value_or(poses.empty() ? pose : poses.back()));
    score.worst_place_m =
        std::max(score.worst_place_m, norm(poses.back().translation_m - pose.translation_m));
    score.worst_odometry_m = std::max(
        score.worst_odometry_m, std::hypot(odometry[k].x_m - drive[k].x_m, odometry[k].y_m - drive[k].y_m));
    if (k > 0) score.driven_m += std::hypot(drive[k].x_m - drive[k - 1].x_m, drive[k].y_m - drive[k - 1].y_m);
  }
  score.frames = static_cast<int>(drive.size());
  score.locate_ms /= score.frames, score.add_ms /= score.frames;
  score.map_mib = static_cast<double>(memory.map().bytes()) / (1 << 20);
  score_surface(score, room, memory.map(), seen);
  DepthErrors errors;
  for (std::size_t k = 10; k + 1 < drive.size(); k += std::max<std::size_t>(1, drive.size() / 12)) {
    // Half a period after a frame.
    const Pose pose = camera_on(drive[k], (static_cast<double>(k) + 0.5) / options.drive.rate_hz, options);
    errors.add(vision::view_of(memory.map(), pose, options.camera).depth_m,
               render(room, pose, options.camera).depth_m, options.memory.map.far_m);
  }
  score.depth_rms_percent = errors.rms_percent();
  score.depth_known = errors.known();
  return MapRun{score, memory.map(), std::move(poses)};
}

}  // namespace palpable::study
