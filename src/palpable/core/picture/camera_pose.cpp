// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/camera_pose.hpp"

#include <cmath>

namespace palpable {

Transform<WorldFrame, CameraFrame> camera_pose(Point<WorldFrame> position, double heading_rad,
                                               double down_rad) {
  const double c = std::cos(heading_rad), s = std::sin(heading_rad);
  const double cd = std::cos(down_rad), sd = std::sin(down_rad);
  const Vec3 right{s, -c, 0.0};
  const Vec3 forward{c * cd, s * cd, -sd};
  const Vec3 down = cross(forward, right);
  Transform<WorldFrame, CameraFrame> pose;
  pose.rotation = {right.x, down.x, forward.x, right.y, down.y, forward.y, right.z, down.z, forward.z};
  pose.translation_m = position.v;
  return pose;
}

}  // namespace palpable
