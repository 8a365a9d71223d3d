// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/fused_distances.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr int kSize = 48;
constexpr double kTruncation = 4.0;

/// Truncated distances in voxels with noise of known variance.
FusedDistances fused_from(const std::function<double(double, double, double)>& distance, double noise) {
  FusedDistances n;
  n.size = {kSize, kSize, kSize};
  n.distance_m.resize(n.index(kSize, 0, 0));
  n.variance_m2.assign(n.distance_m.size(), static_cast<float>(noise * noise));
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int x = 0; x < kSize; ++x)
    for (int y = 0; y < kSize; ++y)
      for (int z = 0; z < kSize; ++z)
        n.distance_m[n.index(x, y, z)] = static_cast<float>(
            std::clamp(distance(x, y, z) + noise * normal(random), -kTruncation, kTruncation));
  return n;
}

/// RMS error within two voxels of the surface.
double error(const FusedDistances& n, const std::function<double(double, double, double)>& distance) {
  double squares = 0.0, count = 0.0;
  for (int x = 4; x < kSize - 4; ++x)
    for (int y = 4; y < kSize - 4; ++y)
      for (int z = 4; z < kSize - 4; ++z) {
        const double truth = distance(x, y, z);
        if (std::abs(truth) > 2.0) continue;
        squares += std::pow(static_cast<double>(n.distance_m[n.index(x, y, z)]) - truth, 2.0), count += 1.0;
      }
  return std::sqrt(squares / count);
}

double plane(double x, double y, double z) { return 0.48 * x + 0.6 * y + 0.64 * z - 40.0; }
double ball(double x, double y, double z) { return std::hypot(x - 23.5, y - 23.5, z - 23.5) - 14.0; }
double box(double x, double y, double z) {
  return std::max({std::abs(x - 23.5), std::abs(y - 23.5), std::abs(z - 23.5)}) - 12.0;
}

TEST(FusedDistances, LoseNoiseWithoutShrinking) {
  for (const auto& solid : {plane, ball}) {
    FusedDistances n = fused_from(solid, 0.3);
    const double before = error(n, solid);
    smooth(n, kTruncation, {}, Work{});
    EXPECT_LT(error(n, solid), 0.35 * before);
  }
  // The given noise replaces the estimate from the voxels.
  FusedDistances n = fused_from(ball, 0.3);
  n.variance_m2.assign(n.variance_m2.size(), -1.0F);
  const double before = error(n, ball);
  smooth(n, kTruncation, {.noise_m = 0.3}, Work{});
  EXPECT_LT(error(n, ball), 0.35 * before);
}

TEST(FusedDistances, KeepFeaturesLargerThanTheNoise) {
  FusedDistances n = fused_from(box, 0.0);
  const FusedDistances before = n;
  smooth(n, kTruncation, {}, Work{});
  EXPECT_EQ(n.distance_m, before.distance_m);
  n.variance_m2.assign(n.variance_m2.size(), 0.01F * 0.01F);
  smooth(n, kTruncation, {}, Work{});
  EXPECT_LT(error(n, box), 0.03);
}

}  // namespace
}  // namespace palpable::sculpt
