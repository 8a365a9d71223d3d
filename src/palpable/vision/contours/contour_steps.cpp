// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/contours/contour_steps.hpp"

#include "palpable/vision/contours/contour_corners.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace palpable::vision {
namespace {

bool is_ridge(const Raster<float>& s, int x, int y, float nx, float ny) {
  const float here = s(x, y);
  const auto fx = static_cast<float>(x);
  const auto fy = static_cast<float>(y);
  return here >= bilinear(s, fx + nx, fy + ny) && here > bilinear(s, fx - nx, fy - ny);
}

}  // namespace

float bilinear(const Raster<float>& values, float x, float y) {
  x = std::clamp(x, 0.0F, static_cast<float>(values.width() - 1));
  y = std::clamp(y, 0.0F, static_cast<float>(values.height() - 1));
  const int x0 = std::min(static_cast<int>(x), values.width() - 2);
  const int y0 = std::min(static_cast<int>(y), values.height() - 2);
  const float u = x - static_cast<float>(x0);
  const float v = y - static_cast<float>(y0);
  return (1 - v) * ((1 - u) * values(x0, y0) + u * values(x0 + 1, y0)) +
         v * ((1 - u) * values(x0, y0 + 1) + u * values(x0 + 1, y0 + 1));
}

double otsu_threshold(const Raster<float>& values) {
  constexpr int kLevels = 256;
  std::array<std::size_t, kLevels> number{};
  for (const float v : values.values())
    ++number[static_cast<std::size_t>(std::clamp(static_cast<int>(v * kLevels), 0, kLevels - 1))];
  std::array<double, kLevels> share{};
  for (std::size_t h = 0; h < share.size(); ++h)
    share[h] = static_cast<double>(number[h]) / static_cast<double>(values.count());
  double total = 0.0;
  for (int h = 0; h < kLevels; ++h) total += h * share[static_cast<std::size_t>(h)];
  double below = 0.0;
  double mean_below = 0.0;
  double best = -1.0;
  int threshold = 0;
  for (int k = 0; k < kLevels - 1; ++k) {
    below += share[static_cast<std::size_t>(k)];
    mean_below += k * share[static_cast<std::size_t>(k)];
    if (below <= 0.0 || below >= 1.0) continue;
    const double between =
        (total * below - mean_below) * (total * below - mean_below) / (below * (1.0 - below));
    if (between > best) best = between, threshold = k + 1;
  }
  return threshold / static_cast<double>(kLevels);
}

Raster<float> ridge_lines(const Raster<float>& strength, const Raster<float>& tangent_x,
                          const Raster<float>& tangent_y, double threshold, const LineOptions& options,
                          const Work& work) {
  const double low = options.followed_share * threshold;
  Raster<float> ridge(strength.width(), strength.height());
  parallel_for(work, strength.height(), 16, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < strength.width(); ++x) {
        const float s = strength(x, y);
        if (s > 0.0F && s >= static_cast<float>(low) &&
            is_ridge(strength, x, y, -tangent_y(x, y), tangent_x(x, y)))
          ridge(x, y) = s;
      }
  });
  std::vector<std::pair<int, int>> open;
  Raster<std::uint8_t> kept(strength.width(), strength.height());
  for (int y = 0; y < strength.height(); ++y)
    for (int x = 0; x < strength.width(); ++x)
      if (ridge(x, y) > 0.0F && ridge(x, y) >= static_cast<float>(threshold))
        open.emplace_back(x, y), kept(x, y) = 1;
  while (!open.empty()) {
    const auto [x, y] = open.back();
    open.pop_back();
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const int u = x + dx;
        const int v = y + dy;
        if (!ridge.contains(u, v) || kept(u, v) != 0 || ridge(u, v) <= 0.0F) continue;
        kept(u, v) = 1;
        open.emplace_back(u, v);
      }
    }
  }
  for (std::size_t i = 0; i < ridge.count(); ++i)
    if (kept.values()[i] == 0) ridge.values()[i] = 0.0F;
  restore_corners(strength, tangent_x, tangent_y, ridge, options.corners, work);
  return ridge;
}

}  // namespace palpable::vision
