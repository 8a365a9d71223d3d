// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/mapping/alignment.hpp"
#include "palpable/vision/mapping/pose_chain.hpp"
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
  /// Of the height and the tilt that a robot on a floor states; its floor is not quite level.
  double height_m = 0.003;
  double tilt_rad = 0.003;
};

struct CameraMemoryOptions {
  SurfaceMapOptions map;
  AlignmentOptions alignment;
  PoseChainOptions chain;
  Motion motion = Motion::odometry;
  OdometryNoise odometry;
  /// How well the last motion predicts the next one if no motion is stated.
  double unstated_m = 0.03;
  double unstated_rad = 0.03;
};

/// The memory of a moving depth camera: finds each picture's pose in the map of those before, and adds it.
/// The world's frame is that of the first stated pose; without stated poses it is the first camera's. One
/// thread.
class CameraMemory {
 public:
  using Pose = Transform<WorldFrame, CameraFrame>;

  /// `options` within their ranges.
  explicit CameraMemory(const CameraMemoryOptions& options)
      : options_(options), map_(options.map), chain_(options.chain) {}

  /// The pose of the next picture, taken with `camera` (of its size); `stated` is its pose by odometry, if
  /// that is known. nullopt: the camera is lost, which happens without stated poses only; a later picture may
  /// find its place again.
  std::optional<Pose> locate(const Raster<float>& depth_m, const Pinhole& camera,
                             const std::optional<Pose>& stated);
  /// Adds a picture at the pose that locate() found.
  void add(const Raster<float>& depth_m, const Pinhole& camera, const Pose& world_from_camera, double time_s);

  const SurfaceMap& map() const { return map_; }
  /// Share of the last picture that lies on the map's surfaces; 0 for the first one, and for exact poses.
  double matched() const { return matched_; }
  /// How often the camera was found to have drifted when it came back to what it had mapped, so that the map
  /// was made anew.
  int closed() const { return closed_; }

 private:
  struct Expected {
    Pose pose;
    PoseMatrix covariance;
    /// Of the motion from the last pose alone.
    PoseMatrix error;
  };
  Expected expected(const std::optional<Pose>& stated) const;
  Pose expected_on_floor(const Pose& stated) const;
  PoseMatrix motion_error(const Transform<CameraFrame, CameraFrame>& motion) const;
  PoseMatrix grown(const Transform<CameraFrame, CameraFrame>& motion, const PoseMatrix& error) const;
  void watch_floor(const Pose& stated);
  void follow_chain(const PosedDepth& frame, AlignedPose& found, const PoseMatrix& error);
  void make_map_anew();

  CameraMemoryOptions options_;
  SurfaceMap map_;
  std::optional<Pose> last_;
  /// Of it, relative to the map around it.
  PoseMatrix covariance_{};
  PoseChain chain_;
  std::optional<Pose> last_stated_;
  /// All stated poses so far stand at the height and with the tilt of the first: only odometry of a robot on
  /// a floor does.
  std::optional<Pose> first_stated_;
  bool is_on_floor_ = true;
  /// The motion between the last two pictures, in the camera's frame.
  Transform<CameraFrame, CameraFrame> last_motion_;
  double matched_ = 0.0;
  /// Times that the camera came back to what it had mapped elsewhere.
  int closed_ = 0;
};

/// The camera of a picture that reduced_depth() reduced by k >= 1.
Pinhole reduced_camera(const Pinhole& camera, int k);

}  // namespace palpable::vision
