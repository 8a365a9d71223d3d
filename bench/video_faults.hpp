// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"

#include <cstdint>

// What spoils the frames of a video, added to rendered ones: the limits of the advice are chosen with it.
namespace palpable::bench {

/// A hand in front of the camera: an ellipse that wanders through the view, drawn from its seed.
struct MovingHand {
  std::uint32_t seed = 1;
  /// Part of the picture that it covers; 0 = no hand.
  double share = 0.0;
  /// Contrast of the mottled skin; 0: smooth.
  double contrast = 0.35;
};
void draw_hand(const MovingHand& hand, int frame, Raster<Rgb8>& picture);

/// The picture out of focus: each pixel is the mean of a disc of this diameter, px; up to 1: unchanged.
Raster<Rgb8> defocused(const Raster<Rgb8>& picture, double diameter_px);

}  // namespace palpable::bench
