// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/height_bounds.hpp"

#include "palpable/models/relief/relief_dilation.hpp"
#include "palpable/models/relief/relief_shaping.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

Raster<float> noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> unit(0.0F, 0.01F);
  Raster<float> z(width, height);
  for (float& value : z.values()) value = unit(random);
  return z;
}

TEST(HeightBounds, BoundHeightAndSlopeOverAnyRectangle) {
  std::mt19937 random(3);
  for (const auto& [width, height] :
       {std::pair{2, 2}, std::pair{5, 3}, std::pair{64, 64}, std::pair{131, 77}}) {
    const auto samples =
        std::make_shared<const Relief>(*Relief::from_samples(noise(width, height, 8), 0.001));
    const Relief& relief = *samples;
    const BoundedRelief bounded(samples);
    std::uniform_real_distribution<double> x(-0.7 * relief.size_x_m(), 0.7 * relief.size_x_m());
    std::uniform_real_distribution<double> y(-0.7 * relief.size_y_m(), 0.7 * relief.size_y_m());
    for (int k = 0; k < 300; ++k) {
      const double x0 = x(random), x1 = x(random), y0 = y(random), y1 = y(random);
      const SurfaceBounds bounds = bounded.bounds_over(x0, y0, x1, y1);
      for (int i = 0; i <= 20; ++i)
        for (int j = 0; j <= 20; ++j) {
          const HeightSample at = relief.sample(x0 + i * (x1 - x0) / 20, y0 + j * (y1 - y0) / 20);
          ASSERT_LE(at.z_m, bounds.highest + 1e-9);
          ASSERT_LE(std::hypot(at.dzdx, at.dzdy), bounds.steepest + 1e-5);
        }
    }
  }
}

TEST(HeightBounds, BoundTheSurfaceOfABallInItsFinerCells) {
  std::mt19937 random(5);
  constexpr double kPixel_m = 2e-4;
  Raster<float> rough = noise(80, 60, 9);
  limit_slope(rough, kPixel_m, 3.0);
  const Relief relief = *Relief::from_samples(std::move(rough), kPixel_m);
  const RefinedRelief surface = *surface_of_ball(relief, 0.001, FinerFit{}, {});
  ASSERT_NE(surface.cells(), nullptr);
  const BoundedRelief bounded(surface);
  std::uniform_real_distribution<double> x(-0.5 * relief.size_x_m(), 0.5 * relief.size_x_m());
  std::uniform_real_distribution<double> y(-0.5 * relief.size_y_m(), 0.5 * relief.size_y_m());
  std::uniform_real_distribution<double> length(-4e-4, 4e-4);
  bool is_ever_higher = false;
  for (int k = 0; k < 3000; ++k) {
    const double x0 = x(random), x1 = x0 + length(random), y0 = y(random), y1 = y0 + length(random);
    const SurfaceBounds bounds = bounded.bounds_over(x0, y0, x1, y1);
    for (int i = 0; i <= 10; ++i)
      for (int j = 0; j <= 10; ++j) {
        const double at_x = x0 + i * (x1 - x0) / 10;
        const double at_y = y0 + j * (y1 - y0) / 10;
        const HeightSample at = surface.sample(at_x, at_y);
        const double slope = std::hypot(at.dzdx, at.dzdy);
        ASSERT_LE(at.z_m, bounds.highest + 1e-9);
        ASSERT_LE(slope, bounds.steepest + 1e-3);
        ASSERT_LE(slope, surface.steepest_slope() + 1e-3);
        is_ever_higher = is_ever_higher || at.z_m > surface.relief()->sample(at_x, at_y).z_m + 1e-6;
      }
  }
  EXPECT_TRUE(is_ever_higher);
}

TEST(HeightBounds, AreTightOverSmallRectangles) {
  Raster<float> step(400, 100);
  for (int y = 0; y < 100; ++y)
    for (int x = 200; x < 400; ++x) step(x, y) = 1.0F;
  const HeightBounds bounds(step);
  EXPECT_EQ(bounds.over(100.0, 40.0, 104.0, 44.0).highest, 0.0F);
  EXPECT_EQ(bounds.over(180.0, 40.0, 185.0, 44.0).highest, 0.0F);
  EXPECT_EQ(bounds.over(198.0, 40.0, 199.0, 44.0).highest, 1.0F);
  EXPECT_EQ(bounds.over(-20.0, -9.0, 100.0, 90.0).highest, 0.0F);
  EXPECT_EQ(bounds.over(180.0, 40.0, 185.0, 44.0).steepest, 0.0F);
  EXPECT_EQ(bounds.over(198.0, 40.0, 199.0, 44.0).steepest, 1.0F);
  EXPECT_LT(bounds.memory_bytes(), 400 * 100 * sizeof(float) / 5);
}

}  // namespace
}  // namespace palpable::models
