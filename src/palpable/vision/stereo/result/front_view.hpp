// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

namespace palpable::vision {

/// The view from between the two cameras, synthesised from both pictures and the disparity (Shi & Pai 1997,
/// section 4): the relief's texture.
struct FrontView {
  /// Of the left picture's size, channels and bits.
  Image picture;
  /// The pair's disparity in pixels, in the front view's frame; NaN only if the input has NaN.
  Raster<float> disparity_px;
};

/// Both pictures are warped by half of the disparity; nearer surfaces occlude farther ones. Pixels that one
/// camera sees come from that picture, and pixels that neither sees from the surface behind. `disparity_px`
/// belongs to the left picture, NaN = unknown (such pixels are left out). Errors: invalid_input for sizes
/// that differ; interrupted.
Result<FrontView> front_view(const StereoPair& pair, const Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
