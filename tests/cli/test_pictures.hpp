// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/core/picture/image.hpp"
#include "palpable/core/picture/raster.hpp"

#include <string>

namespace palpable::test {

/// A textured pair with exact disparity: a far wall (3 px), a slanted floor and a near box (12 px).
struct Pair {
  Raster<Rgb8> left;
  Raster<Rgb8> right;
  /// Disparity of the left picture, in pixels.
  Raster<float> disparity_px;
};
/// `floor_rise_px`: increase of the floor's disparity down to the bottom; 0 = the wall continues.
Pair textured_pair(int width = 160, int height = 120, double floor_rise_px = 3.0);

/// A texture unrelated to the pair's.
Raster<Rgb8> unrelated_picture(int width, int height, unsigned seed);

/// Writes left.png, right.png and truth.pfm into `folder`.
void write_pair(const std::string& folder, const Pair& pair);

}  // namespace palpable::test
