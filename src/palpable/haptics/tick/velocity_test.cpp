// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/tick/velocity.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kT_s = 0.001;

TEST(VelocityEstimator, IsTheBackwardDifferenceWithoutQuantisation) {
  VelocityEstimator velocity(0.0);
  EXPECT_EQ(velocity.update({{1.0, 2.0, 3.0}}, kT_s).v, Vec3{});
  const Vec3 v = velocity.update({{1.001, 2.0, 2.998}}, kT_s).v;
  EXPECT_NEAR(v.x, 1.0, 1e-9);
  EXPECT_NEAR(v.y, 0.0, 1e-9);
  EXPECT_NEAR(v.z, -2.0, 1e-9);
}

TEST(VelocityEstimator, UsesTheTimeThatReallyPassed) {
  VelocityEstimator velocity(0.0);
  velocity.update({{0.0, 0.0, 0.0}}, kT_s);
  EXPECT_NEAR(velocity.update({{0.003, 0.0, 0.0}}, 3.0 * kT_s).v.x, 1.0, 1e-9);
}

TEST(VelocityEstimator, SmoothsTheStepsOfASensorThatTheBackwardDifferenceShows) {
  // 3 mm/s on a 10 µm sensor: a step every third tick, which the backward difference calls 0, 0, 10 mm/s.
  constexpr double kStep_m = 10e-6;
  VelocityEstimator velocity(kStep_m);
  double worst = 0.0;
  for (int n = 0; n < 1000; ++n) {
    const double x = kStep_m * std::round(0.003 * n * kT_s / kStep_m);
    const double v = velocity.update({{x, 0.0, 0.0}}, kT_s).v.x;
    if (n > 50) worst = std::max(worst, std::abs(v - 0.003));
  }
  EXPECT_LT(worst, 0.0015);
}

TEST(VelocityEstimator, FollowsAFastStopWithinTwoTicks) {
  constexpr double kStep_m = 10e-6;
  VelocityEstimator velocity(kStep_m);
  double x = 0.0;
  for (int n = 0; n < 100; ++n) velocity.update({{x += 0.5 * kT_s, 0.0, 0.0}}, kT_s);
  velocity.update({{x, 0.0, 0.0}}, kT_s);
  EXPECT_LT(std::abs(velocity.update({{x, 0.0, 0.0}}, kT_s).v.x), 1e-9);
}

}  // namespace
}  // namespace palpable::haptics
