// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/points/fused_numbers.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr int kSize = 48;
constexpr double kTruncation = 4.0;

/// Distances in voxels, truncated, with noise of which each voxel knows.
FusedNumbers numbers_of(const std::function<double(double, double, double)>& distance, double noise) {
  FusedNumbers n;
  n.size = {kSize, kSize, kSize};
  n.distance_m.resize(n.index(kSize, 0, 0));
  n.noise2_m2.assign(n.distance_m.size(), static_cast<float>(noise * noise));
  std::mt19937 random(4);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (int x = 0; x < kSize; ++x)
    for (int y = 0; y < kSize; ++y)
      for (int z = 0; z < kSize; ++z)
        n.distance_m[n.index(x, y, z)] = static_cast<float>(
            std::clamp(distance(x, y, z) + noise * normal(random), -kTruncation, kTruncation));
  return n;
}

/// Root mean square beside the truth of what lies within two voxels of the surface.
double error(const FusedNumbers& n, const std::function<double(double, double, double)>& distance) {
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

TEST(FusedNumbers, LoseNoiseWithoutShrinking) {
  for (const auto& solid : {plane, ball}) {
    FusedNumbers n = numbers_of(solid, 0.3);
    const double before = error(n, solid);
    smooth(n, kTruncation, 0.0, Work{});
    EXPECT_LT(error(n, solid), 0.35 * before);
  }
  // The noise that is stated, in place of what the voxels know.
  FusedNumbers n = numbers_of(ball, 0.3);
  n.noise2_m2.assign(n.noise2_m2.size(), -1.0F);
  const double before = error(n, ball);
  smooth(n, kTruncation, 0.3, Work{});
  EXPECT_LT(error(n, ball), 0.35 * before);
}

TEST(FusedNumbers, KeepWhatStandsOutOfTheNoise) {
  FusedNumbers n = numbers_of(box, 0.0);
  const FusedNumbers before = n;
  smooth(n, kTruncation, 0.0, Work{});
  EXPECT_EQ(n.distance_m, before.distance_m);
  n.noise2_m2.assign(n.noise2_m2.size(), 0.01F * 0.01F);
  smooth(n, kTruncation, 0.0, Work{});
  EXPECT_LT(error(n, box), 0.03);
}

}  // namespace
}  // namespace palpable::sculpt
