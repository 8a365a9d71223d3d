// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_shaping.hpp"

#include "palpable/models/relief/relief.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr double kShapedPixel_m = 0.0002;

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
      ASSERT_GT(greatest_slope(z, kShapedPixel_m), limit);
      limit_slope(z, kShapedPixel_m, limit);
      EXPECT_LE(greatest_slope(z, kShapedPixel_m), limit);
    }
}

TEST(LimitSlope, KeepsGentleSlopes) {
  Raster<float> z(50, 40);
  for (int j = 0; j < 40; ++j)
    for (int i = 0; i < 50; ++i) z(i, j) = static_cast<float>(0.001 * std::sin(0.1 * i) * std::cos(0.08 * j));
  const Raster<float> before = z;
  limit_slope(z, kShapedPixel_m, 3.0);
  EXPECT_EQ(z, before);
}

TEST(LimitSlope, TurnsAStepIntoARampCentredOnIt) {
  Raster<float> z(200, 5);
  for (int j = 0; j < 5; ++j)
    for (int i = 100; i < 200; ++i) z(i, j) = 0.010F;
  limit_slope(z, kShapedPixel_m, 2.0);
  EXPECT_NEAR((z(99, 2) + z(100, 2)) / 2, 0.005, 1e-6);
  // 10 mm at slope 2 / 1.0824 take 26.1 pixels.
  EXPECT_NEAR(z(84, 2), 0.0, 1e-7);
  EXPECT_NEAR(z(115, 2), 0.010, 1e-7);
  EXPECT_NEAR(z(105, 2) - z(95, 2), 10 * 2.0 / 1.0824 * kShapedPixel_m, 1e-6);
  for (int i = 1; i < 200; ++i) ASSERT_GE(z(i, 2), z(i - 1, 2));
}

TEST(CutToSlope, KeepsTheFootOfAStepLevel) {
  Raster<float> z(200, 5);
  for (int j = 0; j < 5; ++j)
    for (int i = 100; i < 200; ++i) z(i, j) = 0.010F;
  cut_to_slope(z, kShapedPixel_m, 2.0);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(z(i, 2), 0.0F);
  EXPECT_NEAR(z(110, 2) - z(105, 2), 5 * 2.0 / 1.0824 * kShapedPixel_m, 1e-6);
  EXPECT_EQ(z(130, 2), 0.010F);
  Raster<float> discs = discs_and_noise(7);
  cut_to_slope(discs, kShapedPixel_m, 3.0);
  EXPECT_LE(greatest_slope(discs, kShapedPixel_m), 3.0);
}

TEST(SmoothHeights, SpreadsAPixelAsAGaussianWouldAndKeepsItsVolume) {
  constexpr int kMiddle = 50, kRadius = 3;
  Raster<float> z(101, 101);
  z(kMiddle, kMiddle) = 1.0F;
  smooth_heights(z, kRadius);
  double sum = 0.0, variance = 0.0;
  for (int y = 0; y < 101; ++y)
    for (int x = 0; x < 101; ++x) {
      sum += double{z(x, y)};
      variance += (x - kMiddle) * (x - kMiddle) * double{z(x, y)};
    }
  EXPECT_NEAR(sum, 1.0, 1e-5);
  EXPECT_NEAR(variance, kRadius * (kRadius + 1.0), 1e-3);
  EXPECT_NEAR(z(kMiddle + 3 * kRadius + 1, kMiddle), 0.0, 1e-12);
}

TEST(SmoothHeights, LeavesLevelGroundAndARadiusOfZeroAlone) {
  Raster<float> level(30, 20, 0.004F);
  smooth_heights(level, 5);
  for (const float z : level.values()) EXPECT_NEAR(z, 0.004, 1e-9);
  Raster<float> rough = discs_and_noise(3);
  const Raster<float> before = rough;
  smooth_heights(rough, 0);
  EXPECT_EQ(rough, before);
}

TEST(GreatestBend, IsThatOfABowlAndOfTheSplineOverRoughHeights) {
  Raster<float> bowl(60, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x) {
      const double right_m = kShapedPixel_m * (x - 30), down_m = kShapedPixel_m * (y - 30);
      bowl(x, y) = static_cast<float>(0.5 * 40.0 * right_m * right_m - 0.5 * 25.0 * right_m * down_m);
    }
  // Its border continues level, which is a kink; so only the inner half of the bowl counts.
  const double diagonal = std::hypot(20.0, 12.5);
  Raster<float> inner(30, 30);
  for (int y = 0; y < 30; ++y)
    for (int x = 0; x < 30; ++x) inner(x, y) = bowl(x + 15, y + 15);
  EXPECT_GE(greatest_bend_per_m(inner, kShapedPixel_m), 0.99 * (20.0 + diagonal));
  for (unsigned seed = 1; seed < 4; ++seed) {
    const Raster<float> rough = discs_and_noise(seed);
    const double bend = greatest_bend_per_m(rough, kShapedPixel_m);
    const auto relief = *Relief::from_samples(rough, kShapedPixel_m);
    double most = 0.0;
    for (int j = 0; j < 4 * rough.height(); ++j)
      for (int i = 0; i < 4 * rough.width(); ++i) {
        const auto s = relief.curved_sample(-0.5 * relief.size_x_m() + 0.25 * i * kShapedPixel_m,
                                            -0.5 * relief.size_y_m() + 0.25 * j * kShapedPixel_m);
        most = std::max(most, std::abs(0.5 * (s.dzdxx_per_m + s.dzdyy_per_m)) +
                                  std::hypot(0.5 * (s.dzdxx_per_m - s.dzdyy_per_m), s.dzdxy_per_m));
      }
    EXPECT_LE(most, bend);
    EXPECT_GE(most, 0.2 * bend);
  }
}

}  // namespace
}  // namespace palpable::models
