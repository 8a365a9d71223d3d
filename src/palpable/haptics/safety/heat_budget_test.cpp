// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/heat_budget.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kUnknown_N = std::numeric_limits<double>::quiet_NaN();

TEST(HeatBudget, LeavesTheGreatestForceWhereNoneIsStated) {
  for (const double continuous_N : {kUnknown_N, 3.0, 4.0}) {
    HeatBudget budget(3.0, continuous_N);
    for (int k = 0; k < 1000; ++k) budget.add(9.0, 1.0);
    EXPECT_EQ(budget.cap_N(), 3.0);
    EXPECT_FALSE(budget.is_warm());
  }
}

TEST(HeatBudget, AllowsTheGreatestForceForAWhileAndTheContinuousOneForEver) {
  HeatBudget pressed(3.3, 0.88);
  double full_s = 0.0, before_N = pressed.cap_N();
  for (int k = 0; k < 600'000; ++k) {
    const double force_N = pressed.cap_N();
    if (force_N == 3.3) full_s += 0.001;
    pressed.add(force_N * force_N, 0.001);
    // Falls only, by less than a rise limit allows in a tick.
    ASSERT_LE(pressed.cap_N(), before_N);
    ASSERT_GT(pressed.cap_N(), before_N - 0.01);
    before_N = pressed.cap_N();
  }
  // Analytic: the time to four fifths of the heat.
  EXPECT_NEAR(full_s, -HeatBudget::kTime_s * std::log(1.0 - 0.8 * 0.88 * 0.88 / (3.3 * 3.3)), 0.01);
  EXPECT_NEAR(pressed.cap_N(), 0.88, 0.001);
  EXPECT_TRUE(pressed.is_warm());
  HeatBudget held(3.3, 0.88);
  for (int k = 0; k < 600'000; ++k) held.add(0.78 * 0.88 * 0.88, 0.001);
  EXPECT_EQ(held.cap_N(), 3.3);
}

TEST(HeatBudget, NeverGetsHotterThanByTheContinuousForce) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  HeatBudget budget(8.0, 2.0, 0.5);
  for (int k = 0; k < 100'000; ++k) {
    const double force_N = share(random) < 0.7 ? budget.cap_N() : 0.0;
    // A stall is without force.
    budget.add(force_N * force_N, force_N == 0.0 && share(random) < 0.01 ? 5.0 * share(random) : 0.001);
    ASSERT_LE(budget.heat(), 1.0);
    ASSERT_GE(budget.cap_N(), 2.0);
    ASSERT_LE(budget.cap_N(), 8.0);
  }
}

TEST(HeatBudget, ComesBackInAPause) {
  HeatBudget budget(3.0, 1.5, 1.0);
  EXPECT_NEAR(budget.cap_N(), 1.5, 1e-12);
  for (int k = 0; k < 7'000; ++k) budget.add(0.0, 0.001);
  EXPECT_EQ(budget.cap_N(), 3.0);
}

}  // namespace
}  // namespace palpable::haptics
