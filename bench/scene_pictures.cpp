// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "scene_pictures.hpp"

#include "palpable/core/work.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace palpable::bench {
namespace {

/// Rays per pixel along each axis: edges become mixed pixels, as a camera's do.
constexpr int kRays = 3;

/// The light that a camera receives, before its sensor.
Raster<Colour> light_of(const Description& scene, double camera_x, const Degradation& d) {
  Raster<Colour> out(kSceneWidth, kSceneHeight);
  parallel_for({}, kSceneHeight, 8, [&](int begin, int end) {
    for (int y = begin; y < end; ++y)
      for (int x = 0; x < kSceneWidth; ++x)
        for (int k = 0; k < kRays * kRays; ++k) {
          const double px = x + (k % kRays + 0.5) / kRays - 0.5;
          const double py =
              y + (k / kRays + 0.5) / kRays - 0.5 - d.lower_px - d.roll_px * (px / kSceneWidth - 0.5);
          const Hit hit = first_hit(scene.surfaces, camera_x, px, py);
          const Colour c = scene.surfaces[hit.surface].texture.at(hit.x, py);
          for (std::size_t i = 0; i < 3; ++i) out(x, y)[i] += c[i] / (kRays * kRays);
        }
  });
  return out;
}

/// Unsharp masking at one pixel.
double sharpened(const Raster<Colour>& light, int x, int y, std::size_t channel, double share) {
  const double centre = light(x, y)[channel];
  if (share <= 0.0) return centre;
  double mean = 0.0;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      mean +=
          light(std::clamp(x + dx, 0, kSceneWidth - 1), std::clamp(y + dy, 0, kSceneHeight - 1))[channel] /
          9.0;
  return std::max(0.0, centre + share * (centre - mean));
}

}  // namespace

Image picture_of(const Description& scene, double camera_x, std::uint64_t noise_seed) {
  const Degradation& right = scene.degradation;
  const Degradation ideal{.noise = right.noise, .sharpening = right.sharpening};
  const Degradation& d = camera_x > 0.0 ? right : ideal;
  const Raster<Colour> light = light_of(scene, camera_x, d);
  Image out{kSceneWidth, kSceneHeight, 3, 8,
            std::vector<float>(static_cast<std::size_t>(kSceneWidth) * kSceneHeight * 3)};
  for (int y = 0; y < kSceneHeight; ++y) {
    Random noise(noise_seed * 1000003U + static_cast<std::uint64_t>(y));
    for (int x = 0; x < kSceneWidth; ++x)
      for (std::size_t i = 0; i < 3; ++i) {
        const double exposed = d.gain * std::pow(sharpened(light, x, y, i, d.sharpening), d.gamma) +
                               d.offset + d.noise * noise.normal();
        out.samples[(static_cast<std::size_t>(y) * kSceneWidth + static_cast<std::size_t>(x)) * 3 + i] =
            static_cast<float>(std::round(std::clamp(exposed, 0.0, 1.0) * 255.0) / 255.0);
      }
  }
  return out;
}

}  // namespace palpable::bench
