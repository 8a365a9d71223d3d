// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/vec3.hpp"
#include "palpable/vision/stereo/problem/rectifying_transform.hpp"

#include <vector>

namespace palpable::vision {

/// A camera with its lens: its matrix in pixels, distortion in OpenCV's order (0, 4, 5, 8, 12 or 14).
struct LensCamera {
  Matrix3 matrix = kIdentity3;
  std::vector<double> distortion;
};

/// Two calibrated cameras: p_right = rotation * p_left + translation_m (metres).
struct LensPair {
  LensCamera left;
  LensCamera right;
  Matrix3 rotation = kIdentity3;
  Vec3 translation_m;
};

/// Assumed horizontal field of view of an unknown camera: that of a phone.
inline constexpr double kUsualFieldOfView_deg = 65.0;

/// A camera without distortion and with the assumed field of view, for a picture of this size.
LensCamera usual_camera(int width, int height);

}  // namespace palpable::vision
