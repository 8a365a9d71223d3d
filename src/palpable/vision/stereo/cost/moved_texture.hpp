// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/cost/matching_cost.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

// For tests only.
namespace palpable::vision {

inline constexpr int kTextureWidth = 90;
inline constexpr int kTextureHeight = 40;
inline constexpr int kTextureShift = 7;

/// A textured picture whose content is shifted by `shift` pixels to the left, with its levels multiplied by
/// `gain`.
inline MatchView moved_texture(int shift, double gain) {
  Raster<Rgb8> colour(kTextureWidth, kTextureHeight);
  Raster<std::uint8_t> luma(kTextureWidth, kTextureHeight);
  for (int y = 0; y < kTextureHeight; ++y)
    for (int x = 0; x < kTextureWidth; ++x) {
      const auto level = static_cast<std::uint8_t>(std::lround(255.0 * gain * texture(x + shift, y, 0)));
      colour(x, y) = {level, level, level};
      luma(x, y) = level;
    }
  return match_view(colour, luma, {}, {});
}

}  // namespace palpable::vision
