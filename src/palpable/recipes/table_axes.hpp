// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/point_cloud.hpp"
#include "palpable/vision/motion/camera_motion.hpp"

#include <array>
#include <cstdint>
#include <span>

namespace palpable::recipes {

/// Axes of a filmed model: z is the normal of the plane on which it stands, towards the cameras; y lies in
/// the plane, away from them.
struct TableAxes {
  /// Rotation axes_from_world, row-major.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  /// Added after the rotation; table_axes() leaves it zero.
  Vec3 translation;

  Transform<SceneFrame, WorldFrame> axes_from_world() const;
};

/// Estimates the axes from the structure. The plane's direction is that on which most points lie (RANSAC);
/// only the direction of parallel planes matters. `structure` and `poses` must not be empty.
TableAxes table_axes(const PointCloud& structure, std::span<const vision::CameraPose> poses,
                     std::uint64_t seed);

}  // namespace palpable::recipes
