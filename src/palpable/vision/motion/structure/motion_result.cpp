// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/motion_result.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {
namespace {

// The old world frame in the first camera's frame.
Transform<WorldFrame, WorldFrame> first_camera_from_world(const FoundMotion& found) {
  const auto first =
      std::find_if(found.poses.begin(), found.poses.end(), [](const auto& pose) { return pose.has_value(); });
  const auto camera_from_world = camera_pose(**first).inverse();
  Transform<WorldFrame, WorldFrame> out;
  out.rotation = camera_from_world.rotation;
  out.translation_m = camera_from_world.translation_m;
  return out;
}

double reprojection_rms_px(const FoundMotion& found, std::span<const PointTrack> tracks) {
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!found.points[i]) continue;
    for (std::size_t k = 0; k < found.frames.size(); ++k) {
      if (!found.poses[k] || !tracks[i].in_frame(found.frames[k])) continue;
      const double error =
          projection_error_px(found.camera, *found.poses[k], *found.points[i], tracks[i].in(found.frames[k]));
      sum += error * error, ++count;
    }
  }
  return count > 0 ? std::sqrt(sum / static_cast<double>(count)) : 0.0;
}

}  // namespace

CameraMotion motion_result(const FoundMotion& found, std::span<const PointTrack> tracks) {
  CameraMotion out;
  out.camera = found.camera;
  const auto turned = first_camera_from_world(found);
  std::vector<double> depths;
  for (std::size_t i = 0; i < tracks.size(); ++i) {
    if (!found.points[i]) continue;
    const auto& [x, y, z] = *found.points[i];
    out.points.push_back({turned * Point<WorldFrame>{{x, y, z}}, i});
    depths.push_back(out.points.back().position.v.z);
  }
  const double scale = depths.empty() ? 1.0 : 1.0 / quantile_of(depths, 0.5);
  for (StructurePoint& point : out.points) point.position.v *= scale;
  out.reprojection_rms_px = reprojection_rms_px(found, tracks);
  for (const auto& pose : found.poses) {
    if (!pose) {
      out.poses.emplace_back();
      continue;
    }
    CameraPose moved = turned * camera_pose(*pose);
    moved.translation_m *= scale;
    out.poses.emplace_back(moved);
  }
  return out;
}

}  // namespace palpable::vision
