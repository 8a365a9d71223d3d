// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/camera.hpp"
#include "palpable/core/image.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/vec3.hpp"

#include <array>

namespace palpable::sources {

/// The camera that took the colours, beside the one that measured depth (Kinect and its kin).
struct ColourCamera {
  Pinhole camera;
  /// p_colour = rotation * p_depth + translation_m, row-major, metres.
  std::array<double, 9> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 translation_m;
};

/// The colours as the depth camera would see them: RGBA of the depth map's size; alpha 0 (and mid-grey) where
/// the depth is unknown, lies outside the colour picture, or is hidden from the colour camera by something
/// nearer. Errors: invalid_input where depth.camera is not known or a camera is not for its picture's size.
Result<Image> colour_at_depth(const DepthMap& depth, const Image& colour, const ColourCamera& from);

}  // namespace palpable::sources
