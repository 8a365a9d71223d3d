// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/relief/relief_distance.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr double kDistancePixel_m = 0.0005;

Relief rough(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> height_m(0.0F, 0.0025F);
  Raster<float> samples(60, 50);
  for (float& z : samples.values()) z = height_m(random);
  return *Relief::from_samples(std::move(samples), kDistancePixel_m);
}

TEST(ClosestPoint, IsExactOnAPlane) {
  Raster<float> samples(80, 60);
  for (int j = 0; j < 60; ++j)
    for (int i = 0; i < 80; ++i)
      samples(i, j) = static_cast<float>(0.01 + 0.75 * (i - 39.5) * kDistancePixel_m);
  const Relief plane = *Relief::from_samples(std::move(samples), kDistancePixel_m);
  const Vec3 normal{-0.6, 0.0, 0.8};
  for (const double away : {0.002, -0.002}) {
    const auto found = closest_point(plane, {Vec3{0, 0.001, 0.01} + away * normal});
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->distance_m, away, 1e-8);
    EXPECT_NEAR(norm(found->normal.v - normal), 0.0, 1e-5);
    EXPECT_NEAR(norm(found->surface.v - Vec3{0, 0.001, 0.01}), 0.0, 1e-7);
  }
}

TEST(ClosestPoint, IsNoFartherThanADenseSearch) {
  const Relief relief = rough(3);
  std::mt19937 random(4);
  std::uniform_real_distribution<double> x(-0.014, 0.014);
  std::uniform_real_distribution<double> y(-0.012, 0.012);
  std::uniform_real_distribution<double> z(-0.004, 0.006);
  for (int k = 0; k < 40; ++k) {
    const Vec3 p{x(random), y(random), z(random)};
    const auto found = closest_point(relief, {p});
    ASSERT_TRUE(found);
    double dense = std::numeric_limits<double>::max();
    for (double v = p.y - 0.006; v <= p.y + 0.006; v += 0.00004)
      for (double u = p.x - 0.006; u <= p.x + 0.006; u += 0.00004)
        dense = std::min(dense, norm(Vec3{u, v, relief.sample(u, v).z_m} - p));
    ASSERT_LE(std::abs(found->distance_m), dense + 1e-12);
    ASSERT_GE(std::abs(found->distance_m), dense - 0.00012);
    ASSERT_EQ(found->distance_m < 0, p.z < relief.sample(p.x, p.y).z_m);
    const Vec3 away = p - found->surface.v;
    ASSERT_NEAR(norm(cross(away, found->normal.v)), 0.0, 2e-6) << "the offset is along the normal";
  }
}

/// A sample need not be nearer than its neighbours for the nearest point to be beside it: a search from such
/// samples was up to 150 um too far here.
TEST(ClosestPoint, IsNoFartherThanADenseSearchAboveStepsAndNoise) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> noise_m(0.0F, 0.001F);
  std::uniform_real_distribution<double> beside_m(-0.004, 0.004);
  for (const bool steps : {true, false}) {
    Raster<float> samples(60, 60);
    for (int j = 0; j < 60; ++j)
      for (int i = 0; i < 60; ++i) samples(i, j) = steps ? (i % 20 < 10 ? 0.004F : 0.0F) : noise_m(random);
    const Relief relief = *Relief::from_samples(std::move(samples), 0.0002);
    for (int k = 0; k < 60; ++k) {
      Vec3 p{beside_m(random), beside_m(random), 0.0};
      p.z = relief.sample(p.x, p.y).z_m + (k % 2 == 0 ? 0.0003 : 0.0012);
      const auto found = closest_point(relief, {p});
      ASSERT_TRUE(found);
      const double reach_m = found->distance_m;
      double dense_m = reach_m;
      for (double v = p.y - reach_m; v <= p.y + reach_m; v += 0.00001)
        for (double u = p.x - reach_m; u <= p.x + reach_m; u += 0.00001)
          dense_m = std::min(dense_m, norm(Vec3{u, v, relief.sample(u, v).z_m} - p));
      EXPECT_LE(found->distance_m, dense_m + 1e-8);
    }
  }
}

TEST(ClosestPoint, IsEmptyOutsideTheRectangle) {
  const Relief relief = rough(5);
  EXPECT_FALSE(closest_point(relief, {{0.016, 0, 0}}));
  EXPECT_FALSE(closest_point(relief, {{0, -0.013, 0}}));
  EXPECT_FALSE(closest_point(relief, {{0, 0, std::numeric_limits<double>::quiet_NaN()}}));
  EXPECT_TRUE(closest_point(relief, {{0.0149, 0.0124, 0}}));
}

}  // namespace
}  // namespace palpable::models
