// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/draw/canvas/relief_shading.hpp"

#include "palpable/draw/canvas/colour_map.hpp"

#include <algorithm>
#include <cmath>

namespace palpable::draw {

double shade_of(const models::HeightSample& s) {
  constexpr double kSlopeGain = 2.0;
  const Vec3 normal = unit({-kSlopeGain * s.dzdx, -kSlopeGain * s.dzdy, 1.0});
  const Vec3 light = unit({-1.0, 1.0, std::sqrt(2.0)});
  return 0.45 + 0.55 * std::max(0.0, dot(normal, light)) / light.z;
}

Rgb8 shaded(Rgb8 c, double shade) {
  const auto lit = [shade](std::uint8_t v) {
    return static_cast<std::uint8_t>(std::clamp(std::lround(v * shade), 0L, 255L));
  };
  return {lit(c.r), lit(c.g), lit(c.b)};
}

Raster<Rgb8> shaded_relief(const models::Relief& relief, int width_px, int height_px) {
  Raster<Rgb8> pixels(width_px, height_px);
  const double low = relief.lowest_m();
  const double range = relief.highest_m() - low;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x) {
      const auto s = relief.sample(((x + 0.5) / width_px - 0.5) * relief.size_x_m(),
                                   (0.5 - (y + 0.5) / height_px) * relief.size_y_m());
      pixels(x, y) = shaded(tint_colour(range > 0.0 ? (s.z_m - low) / range : 0.5), shade_of(s));
    }
  return pixels;
}

}  // namespace palpable::draw
