// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_shaping.hpp"

#include "palpable/models/relief/relief.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr double kPixel_m = 0.0002;

double greatest_slope(const Raster<float>& samples, double pixel_m) {
  const auto relief = Relief::from_samples(samples, pixel_m);
  double greatest = 0.0;
  for (int j = 0; j < 5 * samples.height(); ++j)
    for (int i = 0; i < 5 * samples.width(); ++i) {
      const auto s = relief->sample(-0.5 * relief->size_x_m() + 0.2 * i * pixel_m,
                                    -0.5 * relief->size_y_m() + 0.2 * j * pixel_m);
      greatest = std::max(greatest, std::hypot(s.dzdx, s.dzdy));
    }
  return greatest;
}

Raster<float> discs_and_noise(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  Raster<float> z(90, 70);
  for (float& v : z.values()) v = 0.0005F * unit(random);
  for (int k = 0; k < 12; ++k) {
    const float x = 90 * unit(random);
    const float y = 70 * unit(random);
    const float r = 2 + 15 * unit(random);
    const float top = 0.01F * unit(random);
    for (int j = 0; j < 70; ++j)
      for (int i = 0; i < 90; ++i)
        if (std::hypot(static_cast<float>(i) - x, static_cast<float>(j) - y) < r) z(i, j) = top;
  }
  return z;
}

TEST(LimitSlope, KeepsTheSplineWithinTheLimit) {
  for (unsigned seed = 1; seed < 6; ++seed)
    for (const double limit : {0.5, 3.0}) {
      Raster<float> z = discs_and_noise(seed);
      ASSERT_GT(greatest_slope(z, kPixel_m), limit);
      limit_slope(z, kPixel_m, limit);
      EXPECT_LE(greatest_slope(z, kPixel_m), limit);
    }
}

TEST(LimitSlope, KeepsGentleSlopes) {
  Raster<float> z(50, 40);
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 50; ++i) z(i, j) = static_cast<float>(0.001 * std::sin(0.1 * i) * std::cos(0.08 * j));
  const Raster<float> before = z;
  limit_slope(z, kPixel_m, 3.0);
  EXPECT_EQ(z, before);
}

TEST(LimitSlope, TurnsAStepIntoARampCentredOnIt) {
  Raster<float> z(200, 5);
  for (int j = 0; j < 5; ++j)
    for (int i = 100; i < 200; ++i) z(i, j) = 0.010F;
  limit_slope(z, kPixel_m, 2.0);
  EXPECT_NEAR((z(99, 2) + z(100, 2)) / 2, 0.005, 1e-6);
  // 10 mm at slope 2 / 1.0824 take 26.1 pixels.
  EXPECT_NEAR(z(84, 2), 0.0, 1e-7);
  EXPECT_NEAR(z(115, 2), 0.010, 1e-7);
  EXPECT_NEAR(z(105, 2) - z(95, 2), 10 * 2.0 / 1.0824 * kPixel_m, 1e-6);
  for (int i = 1; i < 200; ++i) ASSERT_GE(z(i, 2), z(i - 1, 2));
}

TEST(CutToSlope, KeepsTheFootOfAStepLevel) {
  Raster<float> z(200, 5);
  for (int j = 0; j < 5; ++j)
    for (int i = 100; i < 200; ++i) z(i, j) = 0.010F;
  cut_to_slope(z, kPixel_m, 2.0);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(z(i, 2), 0.0F);
  EXPECT_NEAR(z(110, 2) - z(105, 2), 5 * 2.0 / 1.0824 * kPixel_m, 1e-6);
  EXPECT_EQ(z(130, 2), 0.010F);
  Raster<float> discs = discs_and_noise(7);
  cut_to_slope(discs, kPixel_m, 3.0);
  EXPECT_LE(greatest_slope(discs, kPixel_m), 3.0);
}

}  // namespace
}  // namespace palpable::models
