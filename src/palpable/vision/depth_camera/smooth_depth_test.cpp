// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/depth_camera/smooth_depth.hpp"

#include "palpable/core/picture/camera.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kSide = 96;
constexpr int kEdge = 40;

/// A leaning wall at about 2 m, with a board 0.3 m before it from column kEdge on.
Raster<float> exact_board() {
  Raster<float> depth_m(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      depth_m(x, y) = 2.0F + 0.002F * static_cast<float>(y) - (x >= kEdge ? 0.3F : 0.0F);
  return depth_m;
}

Raster<float> noisy(Raster<float> depth_m) {
  std::mt19937 random(5);
  std::normal_distribution<float> normal;
  for (float& z : depth_m.values()) z += DepthNoise().deviation_m(z) * normal(random);
  return depth_m;
}

/// Root mean square of the errors, without a rim of `rim` pixels beside the edge.
double rms_m(const Raster<float>& exact_m, const Raster<float>& depth_m, int rim) {
  double sum = 0.0, count = 0.0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      if (x >= kEdge - rim && x < kEdge + rim) continue;
      const auto d = static_cast<double>(depth_m(x, y) - exact_m(x, y));
      sum += d * d, ++count;
    }
  return std::sqrt(sum / count);
}

TEST(SmoothDepth, LeavesExactDepthAsItIs) {
  const auto exact_m = exact_board();
  const auto smooth = smooth_depth(exact_m, {}, Work{});
  ASSERT_TRUE(smooth);
  EXPECT_EQ(smooth->level, 0.0);
  EXPECT_TRUE(std::ranges::equal(smooth->depth_m.values(), exact_m.values()));
}

TEST(SmoothDepth, RemovesNoiseAndKeepsEdges) {
  const auto exact_m = exact_board(), noisy_m = noisy(exact_m);
  const auto smooth = smooth_depth(noisy_m, {}, Work{});
  ASSERT_TRUE(smooth);
  EXPECT_NEAR(smooth->level, 1.0, 0.15);
  EXPECT_LT(rms_m(exact_m, smooth->depth_m, 0), 0.25 * rms_m(exact_m, noisy_m, 0));
  for (int y = 0; y < kSide; ++y)
    EXPECT_NEAR(smooth->depth_m(kEdge - 1, y) - smooth->depth_m(kEdge, y), 0.3F, 0.02F) << y;
}

TEST(SmoothDepth, MovesFlyingPixelsToASurfaceAndKeepsHoles) {
  auto depth_m = noisy(exact_board());
  for (int y = 0; y < kSide; ++y) depth_m(kEdge, y) += y % 2 == 0 ? 0.1F : 0.2F;
  depth_m(10, 10) = kUnknownDepth;
  const auto smooth = smooth_depth(depth_m, {}, Work{});
  ASSERT_TRUE(smooth);
  EXPECT_GT(smooth->flying, 48U);
  const auto exact_m = exact_board();
  for (int y = 0; y < kSide; ++y) {
    const float z = smooth->depth_m(kEdge, y) - exact_m(kEdge, y);
    EXPECT_LT(std::min(std::abs(z), std::abs(z - 0.3F)), 0.03F) << y;
  }
  EXPECT_TRUE(std::isnan(smooth->depth_m(10, 10)));
}

TEST(SmoothDepth, TakesNoSlopeForFlyingPixels) {
  Raster<float> exact_m(kSide, kSide);
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      exact_m(x, y) = 0.4F + 0.006F * static_cast<float>(x) + 0.004F * static_cast<float>(y);
  const auto noisy_m = noisy(exact_m);
  const auto smooth = smooth_depth(noisy_m, {}, Work{});
  ASSERT_TRUE(smooth);
  EXPECT_GT(smooth->level, 0.5);
  EXPECT_LT(static_cast<double>(smooth->flying), 0.01 * kSide * kSide);
  EXPECT_LT(rms_m(exact_m, smooth->depth_m, 0), 0.8 * rms_m(exact_m, noisy_m, 0));
}

TEST(SmoothDepth, MeasuresTheNoiseBetweenManyHoles) {
  auto depth_m = noisy(exact_board());
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x)
      if (y % 3 == 0 || (x + y) % 2 == 0) depth_m(x, y) = kUnknownDepth;
  EXPECT_NEAR(noise_level(depth_m, {}), 1.0, 0.25);
}

TEST(SmoothDepth, LeavesWhatIsNoCamerasNoise) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> any(0.5F, 1.5F);
  Raster<float> depth_m(kSide, kSide);
  for (float& z : depth_m.values()) z = any(random);
  const auto smooth = smooth_depth(depth_m, {}, Work{});
  ASSERT_TRUE(smooth);
  EXPECT_TRUE(std::ranges::equal(smooth->depth_m.values(), depth_m.values()));
}

TEST(SmoothDepth, RefusesOptionsOutOfRange) {
  SmoothDepthOptions options;
  options.growth = 0.5;
  EXPECT_FALSE(smooth_depth(exact_board(), options, Work{}));
}

}  // namespace
}  // namespace palpable::vision
