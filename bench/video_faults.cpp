// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "video_faults.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "scene_surfaces.hpp"

namespace palpable::bench {

void draw_hand(const MovingHand& hand, int frame, Raster<Rgb8>& picture) {
  if (!(hand.share > 0)) return;
  Random random(hand.seed * 271ULL + 5);
  const double area = hand.share * static_cast<double>(picture.count());
  const double aspect = random.between(1.0, 1.8);
  const double half_height = std::sqrt(area / (std::numbers::pi * aspect)), half_width = aspect * half_height;
  Texture skin;
  skin.colour = {0.72, 0.53, 0.43};
  skin.contrast = hand.contrast;
  skin.scale_px = 9.0;
  skin.seed = hand.seed;
  const auto wandering = [&](double size) {
    const double rate = random.between(0.05, 0.15), phase = random.between(0, 2 * std::numbers::pi);
    return (0.5 + 0.35 * std::sin(rate * frame + phase)) * size;
  };
  const double x0 = wandering(picture.width()), y0 = wandering(picture.height());
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x) {
      const double u = x - x0, v = y - y0, across = u / half_width, along = v / half_height;
      const double r = across * across + along * along;
      if (r >= 1) continue;
      const Colour colour = skin.at(u + 1000, v + 1000);
      const double shade = 255 * (1 - 0.4 * r);
      const auto level = [&](std::size_t i) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(shade * colour[i]), 0L, 255L));
      };
      picture(x, y) = {level(0), level(1), level(2)};
    }
}

Raster<Rgb8> defocused(const Raster<Rgb8>& picture, double diameter_px) {
  if (!(diameter_px > 1)) return picture;
  const int reach = static_cast<int>(std::ceil(diameter_px / 2));
  std::vector<std::pair<int, int>> disc;
  for (int v = -reach; v <= reach; ++v)
    for (int u = -reach; u <= reach; ++u)
      if (std::hypot(u, v) <= diameter_px / 2) disc.emplace_back(u, v);
  Raster<Rgb8> out(picture.width(), picture.height());
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      std::array<int, 3> sum{};
      for (const auto& [u, v] : disc) {
        const Rgb8 p = picture(std::clamp(x + u, 0, out.width() - 1), std::clamp(y + v, 0, out.height() - 1));
        sum[0] += p.r, sum[1] += p.g, sum[2] += p.b;
      }
      const int count = static_cast<int>(disc.size());
      const auto level = [&](std::size_t i) {
        return static_cast<std::uint8_t>((sum[i] + count / 2) / count);
      };
      out(x, y) = {level(0), level(1), level(2)};
    }
  return out;
}

}  // namespace palpable::bench
