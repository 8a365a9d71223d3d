// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include <span>

namespace palpable::vision {

/// The picture of a frame as a camera would have taken it that reads all pixels in the middle of the frame,
/// where motion.poses are. The movement of the picture follows from the poses around the frame and from the
/// depth of the points that it shows: a plane through them, and between them what they differ from it. The
/// frame has a pose; the picture has the camera's size.
Raster<Rgb8> without_rolling_shutter(const Raster<Rgb8>& picture, const CameraMotion& motion, int frame,
                                     std::span<const int> frame_numbers);

}  // namespace palpable::vision
