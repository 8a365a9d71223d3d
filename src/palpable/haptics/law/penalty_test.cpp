// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// `penalty` on reliefs: a spring along the distance to the surface.
#include "palpable/haptics/law/test_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

LawParameters spring() {
  LawParameters p = frictionless();
  p.law = Law::penalty;
  return p;
}

/// A groove along y with walls of `slope`, its bottom on z = 0.02.
models::Scene v_groove(double slope) {
  Raster<float> z(401, 81);
  for (int j = 0; j < z.height(); ++j)
    for (int i = 0; i < z.width(); ++i)
      z(i, j) = static_cast<float>(0.02 + slope * kPixel_m * std::abs(i - 200));
  return scene_of(std::move(z));
}

TEST(PenaltyLaw, IsTheExactGradientOfWhatItStores) {
  const models::Scene scene = scene_of(random_hills(200, 160, 29));
  const auto& relief = *models::relief_of(scene);
  const auto law = made(scene, spring());
  TouchState state;
  const auto energy = [&](Vec3 at) { return output_at(*law, state, at).stored_J; };
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 2000; ++k) {
    const double x = 0.015 * unit(random);
    const double y = 0.012 * unit(random);
    const Vec3 at{x, y, relief.sample(x, y).z_m - 0.004 * std::abs(unit(random))};
    const Vec3 f = output_at(*law, state, at).force_N.v;
    // Far above the rounding of a sample, 1e-10 m, and far below a pixel.
    const double e = 1e-7;
    ASSERT_NEAR(f.x, -(energy(at + Vec3{e, 0, 0}) - energy(at - Vec3{e, 0, 0})) / (2 * e), 5e-3);
    ASSERT_NEAR(f.y, -(energy(at + Vec3{0, e, 0}) - energy(at - Vec3{0, e, 0})) / (2 * e), 5e-3);
    ASSERT_NEAR(f.z, -(energy(at + Vec3{0, 0, e}) - energy(at - Vec3{0, 0, e})) / (2 * e), 5e-3);
  }
}

TEST(PenaltyLaw, GeneratesNoEnergyOnClosedPathsUnderHills) {
  const models::Scene scene = scene_of(random_hills(200, 160, 30));
  const auto& relief = *models::relief_of(scene);
  const auto law = made(scene, spring());
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 40; ++k) {
    const Vec3 middle{0.012 * unit(random), 0.01 * unit(random), 0.0};
    const double height = relief.sample(middle.x, middle.y).z_m - 0.001;
    const double wide = 0.003 * unit(random);
    const LoopWork loop = work_round(*law, 40000, 0, [&](double angle) {
      return Vec3{middle.x + wide * std::cos(angle), middle.y + 0.002 * std::sin(angle),
                  height + 0.0015 * std::cos(2.0 * angle)};
    });
    EXPECT_LE(std::abs(loop.net_J), 1e-7) << k;
    EXPECT_GT(loop.swing_J, 1e-5) << k;
  }
}

TEST(PenaltyLaw, PushesOutOfAGrooveAsFarAsItsNearestPlaceIsAndNotAside) {
  for (const double slope : {0.5, 1.0, 2.0}) {
    const models::Scene scene = v_groove(slope);
    const double bottom = models::relief_of(scene)->sample(0.0, 0.0).z_m;
    const auto law = made(scene, spring());
    TouchState state;
    for (double beside = -0.0005; beside <= 0.0005; beside += 0.00005) {
      // 3 mm below the bottom, which is the nearest surface point: 1.5 N towards it.
      const Vec3 f = output_at(*law, state, {beside, 0.0, bottom - 0.003}).force_N.v;
      EXPECT_NEAR(norm(f), 1.5, 0.1) << slope << " at " << beside;
      EXPECT_LE(std::abs(f.x), 0.4) << slope << " at " << beside;
    }
  }
}

TEST(PenaltyLaw, KnowsTheDistanceOnSlopes) {
  for (const double slope : {0.0, 0.7, 1.5, 3.0}) {
    Raster<float> z(200, 60);
    for (int j = 0; j < z.height(); ++j)
      for (int i = 0; i < z.width(); ++i) z(i, j) = static_cast<float>(slope * kPixel_m * i);
    const models::Scene scene = scene_of(std::move(z));
    const double height = models::relief_of(scene)->sample(0.0, 0.0).z_m;
    const auto law = made(scene, spring());
    TouchState state;
    const double along = std::sqrt(1.0 + slope * slope);
    for (const double depth : {0.0001, 0.0005, 0.001}) {
      const Vec3 f = output_at(*law, state, {0.0, 0.0, height - depth * along}).force_N.v;
      EXPECT_NEAR(norm(f), 500.0 * depth, 500.0 * 2e-6) << slope;
      EXPECT_NEAR(f.x, -500.0 * depth * slope / along, 500.0 * 2e-6) << slope;
    }
  }
}

}  // namespace
}  // namespace palpable::haptics
