// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/raster.hpp"
#include "palpable/vision/depth_camera/depth_noise.hpp"

namespace palpable::vision {

/// How many standard deviations of the noise two readings of one surface differ at most.
inline constexpr float kSameSurface = 3.0F;

/// The depth of blocks of k x k pixels, k >= 1: the mean of the readings that lie on the same surface as the
/// block's median (the lower one of two). Blocks at the right and lower border may be smaller; blocks without
/// a reading are unknown (NaN).
Raster<float> reduced_depth(const Raster<float>& depth_m, int k, const DepthNoise& noise);

/// Depth without the camera's flying pixels and with less noise; edges stay. A reading between two surfaces
/// in front of and behind it, left and right or above and below, and on neither, becomes unknown; each other
/// one becomes the mean of the 3 x 3 readings on its surface. Unknown pixels (NaN) stay unknown.
Raster<float> clean_depth(const Raster<float>& depth_m, const DepthNoise& noise);

}  // namespace palpable::vision
