// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/camera.hpp"
#include "palpable/core/picture/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"

#include <array>

namespace palpable::sources {

/// The colour camera beside a depth camera (Kinect and similar).
struct ColourCamera {
  Pinhole camera;
  /// p_colour = rotation * p_depth + translation_m, row-major, metres.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 translation_m;
};

/// Registers colours to the depth camera: RGBA of the depth map's size; alpha 0 (and mid-grey) where the
/// depth is unknown, the point is outside the colour picture, or a nearer surface occludes it from the colour
/// camera. Errors: invalid_input if depth.camera is unknown or a camera does not match its picture's size.
Result<Image> colour_at_depth(const DepthMap& depth, const Image& colour, const ColourCamera& from);

}  // namespace palpable::sources
