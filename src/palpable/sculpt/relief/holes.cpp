// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/holes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace palpable::sculpt {
namespace {

bool all_known(const Raster<float>& values) {
  return std::none_of(values.values().begin(), values.values().end(), [](float v) { return std::isnan(v); });
}

/// Half the size; each value the mean of the known ones of its four.
Raster<float> pull(const Raster<float>& fine) {
  Raster<float> coarse((fine.width() + 1) / 2, (fine.height() + 1) / 2);
  for (int y = 0; y < coarse.height(); ++y)
    for (int x = 0; x < coarse.width(); ++x) {
      float sum = 0.0F;
      int known = 0;
      for (int b = 2 * y; b < std::min(2 * y + 2, fine.height()); ++b)
        for (int a = 2 * x; a < std::min(2 * x + 2, fine.width()); ++a)
          if (!std::isnan(fine(a, b))) sum += fine(a, b), ++known;
      coarse(x, y) = known > 0 ? sum / static_cast<float>(known) : std::nanf("");
    }
  return coarse;
}

/// The coarse raster interpolated at a fine pixel.
float between(const Raster<float>& coarse, int x, int y) {
  const float u =
      std::clamp(0.5F * static_cast<float>(x) - 0.25F, 0.0F, static_cast<float>(coarse.width() - 1));
  const float v =
      std::clamp(0.5F * static_cast<float>(y) - 0.25F, 0.0F, static_cast<float>(coarse.height() - 1));
  const int a = static_cast<int>(u);
  const int b = static_cast<int>(v);
  const int a1 = std::min(a + 1, coarse.width() - 1);
  const int b1 = std::min(b + 1, coarse.height() - 1);
  const float s = u - static_cast<float>(a);
  const float t = v - static_cast<float>(b);
  return (1 - t) * ((1 - s) * coarse(a, b) + s * coarse(a1, b)) +
         t * ((1 - s) * coarse(a, b1) + s * coarse(a1, b1));
}

/// Gauss-Seidel towards the mean of the four neighbours, inside the holes only.
void relax(Raster<float>& values, const std::vector<Pixel>& holes, int sweeps) {
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (const auto [x, y] : holes) {
      const int w = values.width() - 1;
      const int h = values.height() - 1;
      values(x, y) = 0.25F * (values(std::max(x - 1, 0), y) + values(std::min(x + 1, w), y) +
                              values(x, std::max(y - 1, 0)) + values(x, std::min(y + 1, h)));
    }
}

}  // namespace

void fill_unknown_heights(Raster<float>& values) {
  if (values.empty() || all_known(values)) return;
  PALPABLE_CHECK(values.width() > 1 || values.height() > 1);
  Raster<float> coarse = pull(values);
  fill_unknown_heights(coarse);
  std::vector<Pixel> holes;
  for (int y = 0; y < values.height(); ++y)
    for (int x = 0; x < values.width(); ++x)
      if (std::isnan(values(x, y))) {
        holes.push_back({x, y});
        values(x, y) = between(coarse, x, y);
      }
  constexpr int kSweeps = 8;
  relax(values, holes, kSweeps);
}

}  // namespace palpable::sculpt
