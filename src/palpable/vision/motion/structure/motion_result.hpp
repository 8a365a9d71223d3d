// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/motion/structure/bundle.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

// Inside vision's sources only.
namespace palpable::vision {

/// Poses of frames (camera_from_world) and points of tracks, in any world frame and scale.
struct FoundMotion {
  Pinhole camera;
  /// The frames that `poses` belong to, rising.
  std::vector<int> frames;
  std::vector<std::optional<BundlePose>> poses;
  /// One for each track.
  std::vector<std::optional<std::array<double, 3>>> points;
};

/// The same in the frame of the first camera that has a pose, scaled to unit median depth of the points
/// there, with the RMS reprojection error. At least one pose.
CameraMotion motion_result(const FoundMotion& found, std::span<const PointTrack> tracks);

}  // namespace palpable::vision
