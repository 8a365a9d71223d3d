// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/filling.hpp"

#include <algorithm>

namespace palpable::vision {

void fill_from_background(const Raster<std::uint8_t>& trusted, Raster<float>& disparity_px) {
  const int width = trusted.width();
  for (int y = 0; y < trusted.height(); ++y) {
    int last = -1;  // the last trusted column
    for (int x = 0; x <= width; ++x) {
      if (x < width && trusted(x, y) == 0) continue;
      if (last >= 0 || x < width) {
        const float at_left = disparity_px(std::max(last, 0), y);
        const float at_right = disparity_px(std::min(x, width - 1), y);
        const float background = last < 0 ? at_right : x == width ? at_left : std::min(at_left, at_right);
        std::fill(disparity_px.row(y).begin() + last + 1, disparity_px.row(y).begin() + x, background);
      }
      last = x;
    }
  }
}

}  // namespace palpable::vision
