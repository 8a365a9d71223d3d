// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/frame.hpp"
#include "palpable/core/picture/camera.hpp"

namespace palpable::vision {

/// The depth of a picture's surfaces as another camera sees them. Readings beside and below each other are
/// one surface unless their depths differ by more than `same_surface` of the farther one; the nearest surface
/// counts, and none is seen from behind. Depths NaN = unknown. Between two cameras at the same place the
/// picture stays as it is.
Raster<float> seen_from(const Raster<float>& depth_m, const Pinhole& camera,
                        const Transform<CameraFrame, CameraFrame>& view_from_camera, const Pinhole& view,
                        double same_surface = 0.05);

}  // namespace palpable::vision
