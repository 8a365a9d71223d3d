// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"
#include "palpable/core/result.hpp"
#include "palpable/core/work.hpp"
#include "palpable/vision/rectification/lens_camera.hpp"

#include <span>

namespace palpable::vision {

/// Removes the distortion of the lens from pictures of one size; the camera keeps its matrix. What the lens
/// did not see repeats the picture's edge. Long work: all threads, polls cancel. Errors: invalid_input for
/// pictures of different sizes; interrupted.
Result<void> undistort(std::span<Raster<Rgb8>* const> pictures, const LensCamera& camera, const Work& work);

}  // namespace palpable::vision
