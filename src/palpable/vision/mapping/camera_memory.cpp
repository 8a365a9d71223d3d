// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/camera_memory.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

using Motion6 = Transform<CameraFrame, CameraFrame>;

double angle_of(const Motion6& m) {
  const double trace = m.rotation[0] + m.rotation[4] + m.rotation[8];
  return std::acos(std::clamp((trace - 1.0) / 2.0, -1.0, 1.0));
}

}  // namespace

CameraMemory::Expected CameraMemory::expected(const std::optional<Pose>& stated) const {
  if (stated && last_stated_) {
    const Motion6 motion = last_stated_->inverse() * *stated;
    const OdometryNoise& noise = options_.odometry;
    return {*last_ * motion,
            {noise.still_m + noise.share * norm(motion.translation_m),
             noise.still_rad + noise.share * angle_of(motion)}};
  }
  return {*last_ * last_motion_, options_.unstated};
}

std::optional<CameraMemory::Pose> CameraMemory::locate(const Raster<float>& depth_m, const Pinhole& camera,
                                                       const std::optional<Pose>& stated) {
  matched_ = 0.0;
  if (stated && (options_.motion == Motion::exact || !last_)) {
    last_ = last_stated_ = stated;
    return last_;
  }
  if (!last_) return last_ = Pose{};
  const Expected e = expected(stated);
  const AlignedPose found = aligned(map_, {depth_m, camera, e.pose}, e.deviation, options_.alignment);
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
