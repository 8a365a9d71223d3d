// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/mapping/alignment.hpp"
#include "palpable/vision/mapping/surface_map.hpp"

#include <optional>

namespace palpable::vision {

/// How the camera's stated motion is used.
enum class Motion : std::uint8_t {
  /// Stated poses are taken as they are.
  exact,
  /// They are odometry: the motion between two of them is right but for a few percent, and is corrected by
  /// the
  /// map.
  odometry
};

/// How far odometry is wrong, one standard deviation: a part that every picture has, and a share of the
/// motion.
struct OdometryNoise {
  double still_m = 0.002;
  double still_rad = 0.002;
  double share = 0.1;
};

struct CameraMemoryOptions {
  SurfaceMapOptions map;
  AlignmentOptions alignment;
  Motion motion = Motion::odometry;
  OdometryNoise odometry;
  /// How well the last motion predicts the next one if no motion is stated.
  PoseDeviation unstated{0.03, 0.03};
};

/// The memory of a moving depth camera: finds each picture's pose in the map of those before, and adds it.
/// The world's frame is that of the first stated pose; without stated poses it is the first camera's. One
/// thread.
class CameraMemory {
 public:
  using Pose = Transform<WorldFrame, CameraFrame>;

  /// `options` within their ranges.
  explicit CameraMemory(const CameraMemoryOptions& options) : options_(options), map_(options.map) {}

  /// The pose of the next picture, taken with `camera` (of its size); `stated` is its pose by odometry, if
  /// that is known. nullopt: the camera is lost, which happens without stated poses only; a later picture may
  /// find its place again.
  std::optional<Pose> locate(const Raster<float>& depth_m, const Pinhole& camera,
                             const std::optional<Pose>& stated);
  /// Adds a picture at the pose that locate() found.
  void add(const Raster<float>& depth_m, const Pinhole& camera, const Pose& world_from_camera,
           double time_s) {
    map_.add({depth_m, camera, world_from_camera}, time_s);
  }

  const SurfaceMap& map() const { return map_; }
  /// Share of the last picture that lies on the map's surfaces; 0 for the first one, and for exact poses.
  double matched() const { return matched_; }

 private:
  struct Expected {
    Pose pose;
    PoseDeviation deviation;
  };
  Expected expected(const std::optional<Pose>& stated) const;

  CameraMemoryOptions options_;
  SurfaceMap map_;
  std::optional<Pose> last_;
  std::optional<Pose> last_stated_;
  /// The motion between the last two pictures, in the camera's frame.
  Transform<CameraFrame, CameraFrame> last_motion_;
  double matched_ = 0.0;
};

/// The camera of a picture that reduced_depth() reduced by k >= 1.
Pinhole reduced_camera(const Pinhole& camera, int k);

}  // namespace palpable::vision
