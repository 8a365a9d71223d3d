// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/consistency.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::vision {

void mark_mutual(std::span<const float> left_px, std::span<const float> right_px, int right_first,
                 std::span<std::uint8_t> trusted) {
  const auto width = static_cast<std::ptrdiff_t>(left_px.size());
  for (std::ptrdiff_t x = 0; x < width; ++x) {
    const auto i = static_cast<std::size_t>(x);
    const std::ptrdiff_t to = x - std::lround(left_px[i]);
    trusted[i] = to >= right_first && to < width &&
                 std::abs(right_px[static_cast<std::size_t>(to)] - left_px[i]) <= 1.0F;
  }
}

void fill_from_behind(const Raster<std::uint8_t>& trusted, Raster<float>& disparity_px) {
  const int width = trusted.width();
  for (int y = 0; y < trusted.height(); ++y) {
    int last = -1;  // the last trusted column
    for (int x = 0; x <= width; ++x) {
      if (x < width && trusted(x, y) == 0) continue;
      if (last >= 0 || x < width) {
        const float at_left = disparity_px(std::max(last, 0), y);
        const float at_right = disparity_px(std::min(x, width - 1), y);
        const float behind = last < 0 ? at_right : x == width ? at_left : std::min(at_left, at_right);
        std::fill(disparity_px.row(y).begin() + last + 1, disparity_px.row(y).begin() + x, behind);
      }
      last = x;
    }
  }
}

}  // namespace palpable::vision
