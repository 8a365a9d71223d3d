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

/// Axes of a filmed model: z out of the plane that it stands on, towards the cameras, y away from them along
/// it.
struct TableAxes {
  /// Row-major, axes from world.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};

  Point<SceneFrame> rotate(Point<WorldFrame> p) const;
  Transform<SceneFrame, CameraFrame> scene_from(const vision::CameraPose& pose) const;
};

/// The axes of what the cameras saw. The plane is the one that most points lie on (RANSAC); of parallel
/// planes the direction alone counts. `structure` must not be empty, nor `poses`.
TableAxes table_axes(const PointCloud& structure, std::span<const vision::CameraPose> poses,
                     std::uint64_t seed);

}  // namespace palpable::recipes
