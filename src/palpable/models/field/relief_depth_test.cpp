// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/models/field/relief_depth.hpp"

#include "palpable/models/relief/relief_distance.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::models {
namespace {

constexpr double kPixel_m = 0.0002;

std::shared_ptr<const Relief> hills() {
  Raster<float> z(160, 120);
  for (int j = 0; j < z.height(); ++j)
    for (int i = 0; i < z.width(); ++i)
      z(i, j) = static_cast<float>(0.01 + 0.002 * std::sin(0.11 * i) * std::cos(0.07 * j) +
                                   0.001 * std::sin(0.23 * j));
  return std::make_shared<const Relief>(*Relief::from_samples(std::move(z), kPixel_m));
}

TEST(ReliefDepth, IsNearTheDistanceToTheSurfaceDownToItsDeepest) {
  const auto relief = hills();
  const ReliefDepth depth = *ReliefDepth::under(relief, {});
  EXPECT_NEAR(depth.deepest_m(), 32 * kPixel_m, 1e-12);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  double worst = 0.0;
  for (int k = 0; k < 400; ++k) {
    const double x = 0.008 * unit(random);
    const double y = 0.006 * unit(random);
    const Vec3 p{x, y, relief->sample(x, y).z_m - 0.004 * std::abs(unit(random))};
    const auto nearest = closest_point(*relief, {p});
    ASSERT_TRUE(nearest);
    const double off_m = std::abs(depth.sample({p}).distance_m - nearest->distance_m);
    worst = std::max(worst, off_m / (20e-6 - nearest->distance_m));
  }
  EXPECT_LE(worst, 0.1);
}

TEST(ReliefDepth, IsContinuousAndNeverChangesMuchFasterThanADistance) {
  const auto relief = hills();
  const ReliefDepth depth = *ReliefDepth::under(relief, {});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  for (int k = 0; k < 20000; ++k) {
    const Vec3 p{0.01 * unit(random), 0.008 * unit(random), 0.006 + 0.008 * unit(random)};
    const Vec3 q = p + 1e-6 * Vec3{unit(random), unit(random), unit(random)};
    ASSERT_LE(std::abs(depth.sample({p}).distance_m - depth.sample({q}).distance_m),
              1.4 * norm(p - q) + 1e-9);
  }
}

}  // namespace
}  // namespace palpable::models
