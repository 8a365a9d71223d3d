// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/median.hpp"

#include <algorithm>
#include <array>

namespace palpable::vision {

Raster<float> median_3x3(const Raster<float>& values, const Work& work) {
  Raster<float> out = values;
  parallel_for(work, std::max(0, values.height() - 2), 16, [&](int begin, int end) {
    for (int y = begin + 1; y < end + 1; ++y)
      for (int x = 1; x + 1 < values.width(); ++x) {
        std::array<float, 9> near{};
        for (int k = 0; k < 9; ++k) near[static_cast<std::size_t>(k)] = values(x - 1 + k % 3, y - 1 + k / 3);
        std::nth_element(near.begin(), near.begin() + 4, near.end());
        out(x, y) = near[4];
      }
  });
  return out;
}

}  // namespace palpable::vision
