// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/cost/sub_pixel.hpp"

#include <array>
#include <cstdlib>

namespace palpable::vision {

Raster<float> membrane_through(const Raster<int>& label_px, int iterations, const Work& work) {
  constexpr std::array<std::array<int, 2>, 4> kBeside{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
  Raster<float> surface(label_px.width(), label_px.height());
  std::copy(label_px.values().begin(), label_px.values().end(), surface.values().begin());
  Raster<float> next = surface;
  for (int i = 0; i < iterations && !work.cancelled(); ++i) {
    parallel_for(work, surface.height(), 32, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) {
        for (int x = 0; x < surface.width(); ++x) {
          const int label = label_px(x, y);
          float sum = 0.0F;
          float count = 0.0F;
          for (const auto [dx, dy] : kBeside) {
            if (!label_px.contains(x + dx, y + dy) || std::abs(label_px(x + dx, y + dy) - label) > 1)
              continue;
            sum += surface(x + dx, y + dy);
            count += 1.0F;
          }
          const auto middle = static_cast<float>(label);
          next(x, y) = count > 0.0F ? std::clamp(sum / count, middle - 0.5F, middle + 0.5F) : middle;
        }
      }
    });
    std::swap(surface, next);
  }
  return surface;
}

}  // namespace palpable::vision
