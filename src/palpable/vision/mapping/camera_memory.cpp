// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/camera_memory.hpp"

#include "palpable/vision/mapping/pose_carry.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace palpable::vision {
namespace {

using Motion6 = Transform<CameraFrame, CameraFrame>;

double angle_of(const Motion6& m) {
  const double trace = m.rotation[0] + m.rotation[4] + m.rotation[8];
  return std::acos(std::clamp((trace - 1.0) / 2.0, -1.0, 1.0));
}

/// What is left of a covariance with that information.
PoseMatrix certain_with(const PoseMatrix& covariance, const PoseMatrix& information) {
  using Square = Eigen::Matrix<double, 6, 6>;
  const Square before = eigen_of(covariance);
  const Square sum = Square::Identity() + before * eigen_of(information);
  const Square after = sum.partialPivLu().solve(before);
  return matrix_of(0.5 * (after + after.transpose()));
}

}  // namespace

void CameraMemory::watch_floor(const Pose& stated) {
  if (!first_stated_) first_stated_ = stated;
  constexpr double kSame = 1e-4;
  const auto motion = stated * first_stated_->inverse();
  const auto& r = motion.rotation;
  const double tilt = std::hypot(r[2], r[5]);
  const double rise_m = stated.translation_m.z - first_stated_->translation_m.z;
  is_on_floor_ = is_on_floor_ && tilt < kSame && std::abs(rise_m) < kSame;
}

/// The correction that the last picture found is a turn about the vertical and a shift on the floor; height
/// and tilt are those that are stated, so they do not drift where a wall alone is seen.
CameraMemory::Pose CameraMemory::expected_on_floor(const Pose& stated) const {
  const auto found = *last_ * last_stated_->inverse();
  const double turn_rad = std::atan2(found.rotation[3], found.rotation[0]);
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  Transform<WorldFrame, WorldFrame> correction{{c, -s, 0, s, c, 0, 0, 0, 1}, {}, 1.0};
  correction.translation_m = last_->translation_m - correction.rotate(last_stated_->translation_m);
  correction.translation_m.z = 0.0;
  return correction * stated;
}

PoseMatrix CameraMemory::motion_error(const Motion6& motion) const {
  const OdometryNoise& noise = options_.odometry;
  const double place_m = noise.still_m + noise.share * norm(motion.translation_m);
  const double turn_rad = noise.still_rad + noise.share * angle_of(motion);
  if (!is_on_floor_) return independent_errors({turn_rad, turn_rad, turn_rad}, {place_m, place_m, place_m});
  return independent_errors({noise.tilt_rad, noise.tilt_rad, turn_rad}, {place_m, place_m, noise.height_m});
}

/// The covariance of the last pose, and what the motion from there adds: what the picture does not show, as
/// the way along a wall, becomes less certain from picture to picture.
PoseMatrix CameraMemory::grown(const Motion6& motion, const PoseMatrix& error) const {
  const PoseMatrix6 carry = carried_by(last_->rotate(motion.translation_m));
  PoseMatrix6 sum = carry * eigen_of(covariance_) * carry.transpose();
  // Height and tilt are stated, not added up.
  if (is_on_floor_)
    for (const int axis : {0, 1, 5}) {
      sum.row(axis).setZero();
      sum.col(axis).setZero();
    }
  return matrix_of(sum + PoseMatrix6(eigen_of(error)));
}

CameraMemory::Expected CameraMemory::expected(const std::optional<Pose>& stated) const {
  if (stated && last_stated_) {
    const Motion6 motion = last_stated_->inverse() * *stated;
    const PoseMatrix error = motion_error(motion);
    return {is_on_floor_ ? expected_on_floor(*stated) : *last_ * motion, grown(motion, error), error};
  }
  const double turn = options_.unstated_rad, place = options_.unstated_m;
  const PoseMatrix error = independent_errors({turn, turn, turn}, {place, place, place});
  return {*last_ * last_motion_, error, error};
}

/// Adds the motion to the chain, and looks whether the camera has come back to what it mapped before.
void CameraMemory::follow_chain(const PosedDepth& frame, AlignedPose& found, const PoseMatrix& error) {
  chain_.move(*last_, found.world_from_camera, certain_with(error, found.information));
  const auto other = relocated(map_, {frame.depth_m, frame.camera, found.world_from_camera}, found,
                               chain_.drift(), options_.alignment);
  if (!other) return;
  chain_.close(found.world_from_camera, other->world_from_camera);
  found = *other;
  ++closed_;
  make_map_anew();
}

void CameraMemory::make_map_anew() {
  map_ = SurfaceMap(options_.map);
  for (const KeptPicture& picture : chain_.pictures()) map_.add(picture.posed, picture.time_s);
}

void CameraMemory::add(const Raster<float>& depth_m, const Pinhole& camera, const Pose& world_from_camera,
                       double time_s) {
  const PosedDepth frame{depth_m, camera, world_from_camera};
  map_.add(frame, time_s);
  if (options_.motion != Motion::exact) chain_.keep(frame, time_s);
}

std::optional<CameraMemory::Pose> CameraMemory::locate(const Raster<float>& depth_m, const Pinhole& camera,
                                                       const std::optional<Pose>& stated) {
  matched_ = 0.0;
  if (stated) watch_floor(*stated);
  if (stated && (options_.motion == Motion::exact || !last_)) {
    last_ = last_stated_ = stated;
    return last_;
  }
  if (!last_) return last_ = Pose{};
  const Expected e = expected(stated);
  const PosedDepth frame{depth_m, camera, e.pose};
  AlignedPose found = aligned(map_, frame, e.covariance, options_.alignment);
  if (stated && last_stated_) follow_chain(frame, found, e.error);
  covariance_ = certain_with(e.covariance, found.information);
  matched_ = found.matched;
  const bool is_known = stated && last_stated_;
  last_stated_ = stated;
  if (!found.found && !is_known) {
    // It is looked for where it was seen last.
    last_motion_ = {};
    return std::nullopt;
  }
  last_motion_ = last_->inverse() * found.world_from_camera;
  return last_ = found.world_from_camera;
}

Pinhole reduced_camera(const Pinhole& camera, int k) {
  // Pixel centres are at integers: the centre of the first block of k pixels is at (k - 1) / 2.
  return {camera.fx / k,
          camera.fy / k,
          (camera.cx + 0.5) / k - 0.5,
          (camera.cy + 0.5) / k - 0.5,
          (camera.width + k - 1) / k,
          (camera.height + k - 1) / k};
}

}  // namespace palpable::vision
