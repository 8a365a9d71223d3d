// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

static_assert(HeightField<Relief> && CurvedHeightField<Relief>);

Raster<float> random_samples(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> height_m(0.0F, 0.015F);
  Raster<float> samples(width, height);
  for (float& z : samples.values()) z = height_m(random);
  return samples;
}

TEST(Relief, ReproducesAPlaneExactly) {
  Raster<float> samples(40, 30);
  const double pixel_m = 0.0005;
  for (int j = 0; j < 30; ++j)
    for (int i = 0; i < 40; ++i)
      samples(i, j) = static_cast<float>(0.01 + 0.25 * (i - 19.5) * pixel_m - 0.5 * -(j - 14.5) * pixel_m);
  const auto relief = Relief::from_samples(samples, pixel_m);
  ASSERT_TRUE(relief);
  const HeightSample s = relief->sample(0.0031, -0.0023);
  EXPECT_NEAR(s.z_m, 0.01 + 0.25 * 0.0031 + 0.5 * 0.0023, 1e-8);
  EXPECT_NEAR(s.dzdx, 0.25, 1e-5);
  EXPECT_NEAR(s.dzdy, -0.5, 1e-5);
}

TEST(Relief, StaysWithinTheExtremesOfItsFourByFourSamples) {
  const Raster<float> samples = random_samples(23, 17, 1);
  const auto relief = Relief::from_samples(samples, 0.001);
  ASSERT_TRUE(relief);
  std::mt19937 random(2);
  std::uniform_real_distribution<double> place(-0.015, 0.015);
  for (int k = 0; k < 20000; ++k) {
    const double x = place(random);
    const double y = place(random);
    const int i = static_cast<int>(std::floor(x / 0.001 + 11.0));
    const int j = static_cast<int>(std::floor(8.0 - y / 0.001));
    float low = std::numeric_limits<float>::max();
    float high = std::numeric_limits<float>::lowest();
    for (int b = -1; b <= 2; ++b)
      for (int a = -1; a <= 2; ++a) {
        const float z = samples(std::clamp(i + a, 0, 22), std::clamp(j + b, 0, 16));
        low = std::min(low, z);
        high = std::max(high, z);
      }
    const double z = relief->sample(x, y).z_m;
    ASSERT_GE(z, low - 1e-9);
    ASSERT_LE(z, high + 1e-9);
  }
}

TEST(Relief, HasTheExactDerivativesOfItsHeight) {
  const auto relief = Relief::from_samples(random_samples(23, 17, 3), 0.001);
  ASSERT_TRUE(relief);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.014, 0.014);
  // Heights and slopes are rounded to 1e-7 of the samples' differences: the step is far above that, and far
  // below a pixel.
  const double e = 1e-6;
  for (int k = 0; k < 5000; ++k) {
    const double x = place(random);
    const double y = place(random);
    const CurvedSample c = relief->curved_sample(x, y);
    const HeightSample s = relief->sample(x, y);
    ASSERT_EQ(c.z_m, s.z_m);
    ASSERT_EQ(c.dzdx, s.dzdx);
    ASSERT_EQ(c.dzdy, s.dzdy);
    const auto left = relief->sample(x - e, y);
    const auto right = relief->sample(x + e, y);
    const auto below = relief->sample(x, y - e);
    const auto above = relief->sample(x, y + e);
    ASSERT_NEAR(s.dzdx, (right.z_m - left.z_m) / (2 * e), 1e-3);
    ASSERT_NEAR(s.dzdy, (above.z_m - below.z_m) / (2 * e), 1e-3);
    // Curvatures are up to 8000 here, with kinks at the samples' lines; the tolerance allows for a difference
    // across one.
    ASSERT_NEAR(c.dzdxx_per_m, (right.dzdx - left.dzdx) / (2 * e), 10.0);
    ASSERT_NEAR(c.dzdyy_per_m, (above.dzdy - below.dzdy) / (2 * e), 10.0);
    ASSERT_NEAR(c.dzdxy_per_m, (above.dzdx - below.dzdx) / (2 * e), 10.0);
    ASSERT_LE(std::hypot(s.dzdx, s.dzdy), relief->steepest_slope() * (1 + 1e-9));
  }
}

TEST(Relief, ContinuesAtConstantHeightOutsideItsBorderWithoutAKink) {
  const auto relief = Relief::from_samples(random_samples(12, 9, 5), 0.001);
  ASSERT_TRUE(relief);
  for (double y = -0.004; y < 0.004; y += 0.0007) {
    double slope = relief->sample(0.004, y).dzdx;
    for (double x = 0.004; x < 0.012; x += 1e-6) {
      const double next = relief->sample(x, y).dzdx;
      ASSERT_LT(std::abs(next - slope), 0.05);
      slope = next;
    }
    EXPECT_EQ(relief->sample(0.012, y).dzdx, 0.0);
    EXPECT_EQ(relief->sample(1e9, y).z_m, relief->sample(0.012, y).z_m);
  }
}

TEST(Relief, IsFiniteForEveryInput) {
  const auto relief = Relief::from_samples(random_samples(2, 2, 6), 0.001);
  ASSERT_TRUE(relief);
  const double inf = std::numeric_limits<double>::infinity();
  for (const double x : {0.0, 1e300, -1e300, inf, -inf, std::numeric_limits<double>::quiet_NaN()}) {
    const CurvedSample s = relief->curved_sample(x, -x);
    EXPECT_TRUE(std::isfinite(s.z_m) && std::isfinite(s.dzdx) && std::isfinite(s.dzdyy_per_m));
  }
}

TEST(Relief, RefusesInvalidSamples) {
  EXPECT_FALSE(Relief::from_samples(Raster<float>(1, 5), 0.001));
  EXPECT_FALSE(Relief::from_samples(Raster<float>(5, 5), 0.0));
  EXPECT_FALSE(Relief::from_samples(Raster<float>(5, 5), std::numeric_limits<double>::quiet_NaN()));
  Raster<float> holes(5, 5);
  holes(2, 2) = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(Relief::from_samples(holes, 0.001));
}

TEST(Relief, UsesFourBytesPerSample) {
  const auto relief = Relief::from_samples(Raster<float>(640, 480), 0.0002);
  ASSERT_TRUE(relief);
  EXPECT_LT(relief->memory_bytes(), 640U * 480U * 4U + 1024U);
}

}  // namespace
}  // namespace palpable::models
