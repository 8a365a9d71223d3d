// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/image/gaussian_derivatives.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(HalfGaussian, SumsToOneAndFollowsTheGaussian) {
  for (const double sigma : {0.5, 1.0, 3.0}) {
    const std::vector<float> taps = half_gaussian(sigma);
    const float sum = 2.0F * std::accumulate(taps.begin() + 1, taps.end(), 0.0F) + taps[0];
    EXPECT_NEAR(sum, 1.0F, 1e-6F);
    EXPECT_NEAR(taps[1] / taps[0], std::exp(-0.5 / (sigma * sigma)), 1e-6);
  }
}

TEST(GaussianGradient, OfARampIsItsSlope) {
  Raster<float> ramp(60, 50);
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 60; ++x) ramp(x, y) = 0.25F * static_cast<float>(x) - 0.5F * static_cast<float>(y);
  Gradient out{Raster<float>(60, 50), Raster<float>(60, 50)};
  gaussian_gradient(ramp, 2.0, 0, 50, out);
  for (int y = 12; y < 38; ++y)
    for (int x = 12; x < 48; ++x) {
      EXPECT_NEAR(out.x(x, y), 0.25F, 1e-4F);
      EXPECT_NEAR(out.y(x, y), -0.5F, 1e-4F);
    }
}

TEST(GaussianBlur, OfAPointIsAGaussian) {
  Raster<float> point(41, 41);
  point(20, 20) = 1.0F;
  const Raster<float> blurred = gaussian_blur(point, 2.0, {});
  const double peak = static_cast<double>(blurred(20, 20));
  EXPECT_NEAR(peak, 1.0 / (2.0 * 3.14159265 * 4.0), 1e-4);
  EXPECT_NEAR(static_cast<double>(blurred(23, 18)) / peak, std::exp(-0.5 * (9.0 + 4.0) / 4.0), 1e-4);
}

TEST(GaussianBlur, KeepsAConstantPictureUpToItsBorder) {
  const Raster<float> blurred = gaussian_blur(Raster<float>(20, 10, 3.0F), 2.0, {});
  for (const float v : blurred.values()) EXPECT_NEAR(v, 3.0F, 1e-5F);
}

}  // namespace
}  // namespace palpable::vision
