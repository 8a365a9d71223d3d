// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

// Helpers for tests of laws: scenes of simple reliefs, and a touch of one tick.

#include "palpable/haptics/law/laws.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {

inline constexpr double kPixel_m = 0.0002;

inline models::Scene scene_of(Raster<float> samples, double pixel_m = kPixel_m) {
  auto relief = models::Relief::from_samples(std::move(samples), pixel_m);
  models::Scene scene;
  scene.model = std::make_shared<const models::Relief>(*std::move(relief));
  return scene;
}

inline models::Scene flat_ground(float z_m = 0.005F) { return scene_of(Raster<float>(100, 80, z_m)); }

inline Raster<float> random_hills(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Raster<float> z(width, height);
  for (int k = 0; k < 40; ++k) {
    const double x = unit(random) * width;
    const double y = unit(random) * height;
    const double s = 4 + 12 * unit(random);
    const double a = 0.006 * (unit(random) - 0.3);
    for (int j = 0; j < height; ++j)
      for (int i = 0; i < width; ++i)
        z(i, j) += static_cast<float>(a * std::exp(-((i - x) * (i - x) + (j - y) * (j - y)) / (2 * s * s)));
  }
  models::limit_slope(z, kPixel_m, 3.0);
  return z;
}

inline std::shared_ptr<const Touchable> made(const models::Scene& scene, const LawParameters& parameters) {
  auto touchable = make_touchable(scene, parameters);
  EXPECT_TRUE(touchable);
  return touchable ? *touchable : nullptr;
}

inline LawParameters frictionless(double radius_m = 0.0) {
  LawParameters p;
  p.stiffness_N_per_m = 500.0;
  p.damping_Ns_per_m = 0.0;
  p.static_friction = 0.0;
  p.radius_m = radius_m;
  return p;
}

inline LawOutput output_at(const Touchable& t, TouchState& state, Vec3 p) {
  Hand hand;
  hand.position = {p};
  return t.evaluate(hand, state);
}

/// Work of the force on a hand along a closed loop: the total, and the range of the accumulated work.
struct LoopWork {
  double net_J = 0.0;
  double swing_J = 0.0;
};

/// `place(angle)` is a closed loop of `ticks` ticks. The first `settling` rounds are not counted.
template <class Place>
LoopWork work_round(const Touchable& touchable, int ticks, int settling, Place place) {
  TouchState state;
  LoopWork loop;
  double low_J = 0.0;
  double high_J = 0.0;
  Vec3 last_m{};
  Vec3 last_N{};
  for (int k = 0; k <= (settling + 1) * ticks; ++k) {
    const Vec3 at_m = place(2 * M_PI * k / ticks);
    const Vec3 force_N = output_at(touchable, state, at_m).force_N.v;
    if (k > settling * ticks) {
      loop.net_J += dot(0.5 * (force_N + last_N), at_m - last_m);
      low_J = std::min(low_J, loop.net_J);
      high_J = std::max(high_J, loop.net_J);
    }
    last_m = at_m;
    last_N = force_N;
  }
  loop.swing_J = high_J - low_J;
  return loop;
}

}  // namespace palpable::haptics
