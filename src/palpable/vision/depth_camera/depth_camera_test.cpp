// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/camera.hpp"
#include "palpable/vision/depth_camera/clean_depth.hpp"
#include "palpable/vision/depth_camera/depth_range.hpp"
#include "palpable/vision/depth_camera/steady_depth.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 60;
constexpr int kHeight = 40;

/// A box at 1 m in front of a wall at 1.5 m, with a camera's noise.
Raster<float> noisy_box(std::mt19937& random, int box_begins = 20) {
  const DepthNoise noise;
  std::normal_distribution<float> normal;
  Raster<float> depth_m(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const float z = x >= box_begins && x < box_begins + 20 ? 1.0F : 1.5F;
      depth_m(x, y) = z + noise.deviation_m(z) * normal(random);
    }
  return depth_m;
}

/// Root mean square of the error on the box and on the wall, away from and at the edge alike.
double error_m(const Raster<float>& depth_m, int box_begins = 20) {
  double sum = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      const double truth = x >= box_begins && x < box_begins + 20 ? 1.0 : 1.5;
      sum += std::pow(static_cast<double>(depth_m(x, y)) - truth, 2);
    }
  return std::sqrt(sum / (kWidth * kHeight));
}

TEST(CleanDepth, HalvesTheNoiseAndKeepsEdges) {
  std::mt19937 random(4);
  const auto noisy = noisy_box(random);
  const auto cleaned = clean_depth(noisy, {});
  EXPECT_LT(error_m(cleaned), 0.5 * error_m(noisy));
}

TEST(CleanDepth, RemovesFlyingPixelsOnly) {
  Raster<float> depth_m(5, 3, 1.0F);
  for (int y = 0; y < 3; ++y) depth_m(3, y) = depth_m(4, y) = 2.0F;
  for (int y = 0; y < 3; ++y) depth_m(2, y) = 1.4F;
  const auto cleaned = clean_depth(depth_m, {});
  for (int y = 0; y < 3; ++y) {
    EXPECT_TRUE(std::isnan(cleaned(2, y)));
    EXPECT_FLOAT_EQ(cleaned(1, y), 1.0F);
    EXPECT_FLOAT_EQ(cleaned(3, y), 2.0F);
  }
}

TEST(CleanDepth, KeepsASlope) {
  Raster<float> depth_m(30, 3);
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 30; ++x) depth_m(x, y) = 1.0F + 0.003F * static_cast<float>(x);
  const auto cleaned = clean_depth(depth_m, {});
  for (int x = 1; x < 29; ++x) EXPECT_NEAR(cleaned(x, 1), depth_m(x, 1), 1e-5F);
}

TEST(ReducedDepth, TakesOneSurfaceOfABlock) {
  Raster<float> depth_m(2, 2, 1.0F);
  depth_m(0, 0) = 3.0F;
  depth_m(1, 1) = kUnknownDepth;
  EXPECT_FLOAT_EQ(reduced_depth(depth_m, 2, {})(0, 0), 1.0F);
  EXPECT_TRUE(std::isnan(reduced_depth(Raster<float>(3, 3, kUnknownDepth), 2, {})(1, 1)));
}

TEST(SteadyDepth, AveragesAStillScene) {
  std::mt19937 random(9);
  SteadyDepth steady({});
  const auto next = [&] { return error_m(steady.add(clean_depth(noisy_box(random), {}), 0.033)); };
  const double single_m = next();
  for (int k = 0; k < 7; ++k) next();
  EXPECT_LT(next(), 0.45 * single_m);
}

// 0.1 m/s at 30 pictures a second, less than the noise of three standard deviations (4.5 mm).
TEST(SteadyDepth, IsNotLateOnAPlateThatMovesByLessThanTheNoise) {
  std::mt19937 random(11);
  std::normal_distribution<float> normal;
  SteadyDepth steady({});
  double lag_m = 0.0;
  for (int k = 0; k < 60; ++k) {
    const float z = 0.9F - 0.0033F * static_cast<float>(std::clamp(k - 20, 0, 20));
    Raster<float> depth_m(kWidth, kHeight);
    for (float& reading : depth_m.values()) reading = z + DepthNoise{}.deviation_m(z) * normal(random);
    const auto& seen_m = steady.add(clean_depth(depth_m, {}), 0.033);
    double sum_m = 0.0;
    for (const float seen : seen_m.values()) sum_m += static_cast<double>(seen - z);
    lag_m = std::max(lag_m, std::abs(sum_m) / static_cast<double>(seen_m.count()));
  }
  EXPECT_LT(lag_m, 0.0005);
}

TEST(SteadyDepth, FollowsAMovingEdgeAtOnce) {
  std::mt19937 random(10);
  SteadyDepth steady({});
  for (int k = 0; k < 8; ++k) steady.add(noisy_box(random), 0.033);
  const auto& moved = steady.add(noisy_box(random, 26), 0.033);
  EXPECT_LT(error_m(moved, 26), 0.01);
}

TEST(SteadyDepth, HoldsALostPixelForAWhile) {
  SteadyDepthOptions options;
  options.hold_s = 0.1;
  SteadyDepth steady(options);
  steady.add(Raster<float>(2, 2, 1.0F), 0.0);
  const Raster<float> lost(2, 2, kUnknownDepth);
  EXPECT_FLOAT_EQ(steady.add(lost, 0.05)(1, 1), 1.0F);
  EXPECT_TRUE(std::isnan(steady.add(lost, 0.06)(1, 1)));
  EXPECT_FLOAT_EQ(steady.add(Raster<float>(2, 2, 1.2F), 0.05)(1, 1), 1.2F);
}

TEST(FollowedRange, StaysForAStillSceneAndFollowsALastingChangeSlowly) {
  std::mt19937 random(3);
  FollowedRange followed(1.0);
  const auto first = followed.add(noisy_box(random), 0.0);
  ASSERT_TRUE(first);
  EXPECT_LT(first->near_m, 1.0);
  EXPECT_GT(first->far_m, 1.5);
  for (int k = 0; k < 100; ++k) {
    const auto now = followed.add(noisy_box(random), 0.033);
    ASSERT_EQ(now->near_m, first->near_m);
    ASSERT_EQ(now->far_m, first->far_m);
  }
  const Raster<float> far(kWidth, kHeight, 3.0F);
  EXPECT_EQ(followed.add(far, 0.5)->far_m, first->far_m);
  const double step_m = followed.add(far, 0.6)->far_m - first->far_m;
  EXPECT_GT(step_m, 0.0);
  EXPECT_LT(step_m, 0.2);
  double far_m = 0.0;
  for (int k = 0; k < 1000; ++k) far_m = followed.add(far, 0.033)->far_m;
  EXPECT_GE(far_m, 3.0);
}

TEST(FollowedRange, HasNoneBeforeADepthIsKnown) {
  FollowedRange followed;
  EXPECT_FALSE(followed.add(Raster<float>(8, 8, kUnknownDepth), 0.0));
}

TEST(DepthCamera, RefusesOptionsOutOfRange) {
  EXPECT_FALSE(check(DepthNoise{-0.1, 0.0}));
  SteadyDepthOptions options;
  options.frames = 0;
  EXPECT_FALSE(check(options));
  options = {};
  options.hold_s = std::nan("");
  EXPECT_FALSE(check(options));
}

}  // namespace
}  // namespace palpable::vision
