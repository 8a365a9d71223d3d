// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/problem/undefined_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace palpable::vision {
namespace {

bool is_defined(const Image& picture, int x, int y) {
  const float* p = picture.pixel(x, y);
  return std::all_of(p, p + (picture.channels >= 3 ? 3 : 1), [](float v) { return std::isfinite(v); });
}

bool is_any_defined(const Image& picture) {
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x)
      if (is_defined(picture, x, y)) return true;
  return false;
}

/// Without the cost of a raster: almost all pictures are.
bool is_all_finite(const Image& picture) {
  return std::all_of(picture.samples.begin(), picture.samples.end(),
                     [](float v) { return std::isfinite(v); });
}

}  // namespace

Raster<std::uint8_t> undefined_pixels(const Image& picture) {
  Raster<std::uint8_t> out(picture.width, picture.height);
  for (int y = 0; y < picture.height; ++y)
    for (int x = 0; x < picture.width; ++x) out(x, y) = is_defined(picture, x, y) ? 0 : 1;
  return out;
}

Result<void> check_any_defined(const StereoPair& pair) {
  for (const Image* picture : {&pair.left, &pair.right})
    if (!is_any_defined(*picture))
      return invalid_input(std::string("the ") + (picture == &pair.left ? "left" : "right") +
                           " picture of the pair has no finite values: all its pixels are NaN or infinite");
  return {};
}

void forget_undefined(const StereoPair& pair, StereoMatch& match) {
  if (is_all_finite(pair.left) && is_all_finite(pair.right)) return;
  const Raster<std::uint8_t> left = undefined_pixels(pair.left), right = undefined_pixels(pair.right);
  Raster<float>& disparity_px = match.disparity.disparity_px;
  const float towards = match.exchanged ? 1.0F : -1.0F;
  for (int y = 0; y < disparity_px.height(); ++y)
    for (int x = 0; x < disparity_px.width(); ++x) {
      const float there = static_cast<float>(x) + towards * disparity_px(x, y);
      const int column = std::isfinite(there) ? static_cast<int>(std::lround(there)) : -1;
      if (left(x, y) == 0 && (!right.contains(column, y) || right(column, y) == 0)) continue;
      disparity_px(x, y) = std::numeric_limits<float>::quiet_NaN();
      for (Raster<float>* map : {&match.confidence, &match.confirmed})
        if (!map->empty()) (*map)(x, y) = 0.0F;
    }
}

}  // namespace palpable::vision
