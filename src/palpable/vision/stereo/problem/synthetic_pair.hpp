// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "palpable/vision/stereo/problem/stereo.hpp"

#include <cmath>
#include <cstdint>

// For tests only: a synthetic stereo pair of known disparity.
namespace palpable::vision {

/// A slanted ground, d = ground_px + slope_x x + slope_y y, and a flat box in front of it.
struct SyntheticScene {
  int width = 160;
  int height = 96;
  double ground_px = 6.0;
  double slope_x = 0.0;
  double slope_y = 0.0;
  double box_px = 14.0;
  int box_left = 60, box_top = 30, box_right = 110, box_bottom = 70;
  /// The right picture's levels: gain * level.
  double right_gain = 1.0;
  /// Vertical offset of the right picture's content, downwards.
  int right_lower_px = 0;

  bool in_box(double x, int y) const {
    return y >= box_top && y < box_bottom && x >= static_cast<double>(box_left) &&
           x < static_cast<double>(box_right);
  }
  double truth(int x, int y) const { return in_box(x, y) ? box_px : ground_px + slope_x * x + slope_y * y; }
};

/// The same with a slanted ground.
inline SyntheticScene slanted_scene() {
  SyntheticScene scene;
  scene.slope_x = 0.02;
  scene.slope_y = 0.03;
  return scene;
}

/// Smooth random texture in 0.1 … 0.9, from a hash of the lattice around (u, v); `kind` chooses another one.
inline double texture(double u, double v, unsigned kind) {
  const auto lattice = [&](double a, double b) {
    auto h = static_cast<std::uint32_t>(static_cast<std::int32_t>(a)) * 0x9E3779B1U ^
             static_cast<std::uint32_t>(static_cast<std::int32_t>(b)) * 0x85EBCA77U ^ kind * 0xC2B2AE3DU;
    h ^= h >> 15U;
    h *= 0x2C1B3C6DU;
    h ^= h >> 12U;
    h *= 0x297A2D39U;
    h ^= h >> 15U;
    return static_cast<double>(h) / 4294967295.0;
  };
  const double s = u / 2.0;
  const double t = v / 2.0;
  const double i = std::floor(s);
  const double j = std::floor(t);
  const auto blend = [](double a, double b, double f) { return a + (b - a) * f * f * (3.0 - 2.0 * f); };
  const double top = blend(lattice(i, j), lattice(i + 1, j), s - i);
  const double bottom = blend(lattice(i, j + 1), lattice(i + 1, j + 1), s - i);
  return 0.1 + 0.8 * blend(top, bottom, t - j);
}

inline StereoPair render(const SyntheticScene& scene) {
  const auto samples = static_cast<std::size_t>(scene.width) * static_cast<std::size_t>(scene.height);
  StereoPair pair;
  pair.left = {scene.width, scene.height, 1, 8, std::vector<float>(samples)};
  pair.right = pair.left;
  for (int y = 0; y < scene.height; ++y) {
    for (int x = 0; x < scene.width; ++x) {
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(scene.width) + static_cast<std::size_t>(x);
      pair.left.samples[i] = static_cast<float>(texture(x, y, scene.in_box(x, y) ? 1U : 0U));
      const int row = y - scene.right_lower_px;
      const double in_box = x + scene.box_px;
      const double on_ground = (x + scene.ground_px + scene.slope_y * row) / (1.0 - scene.slope_x);
      const bool box = scene.in_box(in_box, row);
      pair.right.samples[i] =
          static_cast<float>(scene.right_gain * texture(box ? in_box : on_ground, row, box ? 1U : 0U));
    }
  }
  return pair;
}

/// The fraction of pixels, at least `border` from the picture's edge and seen by both cameras, whose
/// disparity is off by more than `limit_px` or unknown.
inline double bad_fraction(const SyntheticScene& scene, const Raster<float>& disparity_px, double limit_px,
                           int border) {
  int bad = 0;
  int all = 0;
  for (int y = border; y < scene.height - border; ++y) {
    for (int x = border; x < scene.width - border; ++x) {
      const double d = scene.truth(x, y);
      const double right = x - d;
      // In the right picture the box occludes ground at its left.
      const bool hidden = !scene.in_box(x, y) && scene.in_box(right + scene.box_px, y);
      if (hidden || right < 0.0) continue;
      ++all;
      const double error = std::abs(static_cast<double>(disparity_px(x, y)) - d);
      bad += error <= limit_px ? 0 : 1;
    }
  }
  return static_cast<double>(bad) / all;
}

}  // namespace palpable::vision
