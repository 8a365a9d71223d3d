// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/camera_pose.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/study/world/room.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"

#include <cstdint>

namespace palpable::study {

/// The errors of a simulated depth camera. The default has none.
struct CameraNoise {
  /// Standard deviation of a depth reading; readings are independent.
  vision::DepthNoise depth{0.0, 0.0};
  /// Readings outside this range are unknown, m.
  double near_m = 0.0;
  double far_m = std::numeric_limits<double>::infinity();
  /// Standard deviation of a colour channel, 0 ... 255.
  double colour = 0.0;
  /// One frame's seed: frames with the same seed have the same noise.
  std::uint64_t seed = 0;
};

/// What a camera sees.
struct RoomView {
  /// Along the camera's z axis, metres; NaN outside of the noise's range.
  Raster<float> depth_m;
  Raster<Rgb8> colour;
  /// Index into Room::furniture; kFloor, kWalls or kCeiling.
  Raster<std::int16_t> object;
};

/// A picture of the room by exact ray casting through the pixels' centres. `camera` has a size of at least
/// 1 x 1; the pose is rigid (scale 1), and the camera inside the room's free space. Below 10 ms for 320 x 240
/// on one core.
RoomView render(const Room& room, const Transform<WorldFrame, CameraFrame>& world_from_camera,
                const Pinhole& camera, const CameraNoise& noise = {});

/// A camera of this size with square pixels, its axis in the middle, and this horizontal field of view.
Pinhole camera_of(int width, int height, double field_of_view_rad);

}  // namespace palpable::study
