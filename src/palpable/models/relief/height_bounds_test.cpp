// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/height_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

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
