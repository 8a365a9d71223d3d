// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/work.hpp"
#include "palpable/vision/stereo/problem/stereo.hpp"

namespace palpable::vision {

/// A picture as seen from between the two cameras, made from both of them and the depth (Shi & Pai 1997,
/// section 4): the texture of the relief.
struct FrontView {
  /// Of the left picture's size, channels and bits.
  Image picture;
  /// The disparity between the two cameras, in pixels of the whole pair's disparity, in the front view's
  /// frame; no NaN where the input has none.
  Raster<float> disparity_px;
};

/// Both pictures are moved half a disparity towards each other; nearer surfaces cover farther ones; what only
/// one camera sees comes from that one, and what neither does from the surface behind. `disparity_px` belongs
/// to the left picture, NaN = unknown (such pixels are left out). Errors: invalid_input for sizes that
/// differ; interrupted.
Result<FrontView> front_view(const StereoPair& pair, const Raster<float>& disparity_px, const Work& work);

}  // namespace palpable::vision
