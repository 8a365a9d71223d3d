// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"

#include <cstdint>
#include <vector>

#include "scene_surfaces.hpp"

// The pictures that two cameras take of rendered surfaces.
namespace palpable::bench {

/// How the right camera and both sensors differ from ideal ones.
struct Degradation {
  double noise = 1.0 / 255.0;
  double gain = 1.0, offset = 0.0, gamma = 1.0;
  /// Vertical offset of the right picture, which grows towards its right edge.
  double lower_px = 0.0, roll_px = 0.0;
  /// Unsharp masking by both cameras: the share of the difference from the mean of 3 x 3 pixels that is
  /// added.
  double sharpening = 0.0;
};

struct Description {
  std::vector<Surface> surfaces;
  Degradation degradation;
};

/// A camera's picture, quantised to 8 bits. The left camera, at 0, has an ideal exposure and place.
Image picture_of(const Description& scene, double camera_x, std::uint64_t noise_seed);

}  // namespace palpable::bench
