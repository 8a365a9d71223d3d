// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/limits.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

using Force = Vector<DeviceFrame>;

TEST(ForceCap, ReducesTheMagnitudeAndReportsIt) {
  const auto capped = cap_force(Force{{3.0, 0.0, 4.0}}, 2.5);
  EXPECT_TRUE(capped.limited);
  EXPECT_NEAR(capped.force_N.v.x, 1.5, 1e-12);
  EXPECT_NEAR(capped.force_N.v.z, 2.0, 1e-12);
  EXPECT_FALSE(cap_force(Force{{3.0, 0.0, 4.0}}, 5.0).limited);
}

TEST(RiseCap, NeverDelaysARelease) {
  const auto released = cap_rise(Force{{0.0, 0.0, 0.1}}, Force{{0.0, 0.0, 3.0}}, 0.3);
  EXPECT_FALSE(released.limited);
  EXPECT_EQ(released.force_N, (Force{{0.0, 0.0, 0.1}}));
}

TEST(RiseCap, LetsTheForceGrowByNoMoreThanAllowed) {
  const auto risen = cap_rise(Force{{0.0, 0.0, 3.0}}, Force{{0.0, 0.0, 1.0}}, 0.3);
  EXPECT_TRUE(risen.limited);
  EXPECT_NEAR(risen.force_N.v.z, 1.3, 1e-12);
}

TEST(RiseCap, LimitsARotationAtConstantMagnitudeAndAReversal) {
  const auto turned = cap_rise(Force{{1.0, 0.0, 0.0}}, Force{{0.0, 0.0, 1.0}}, 0.3);
  EXPECT_TRUE(turned.limited);
  EXPECT_NEAR(norm(turned.force_N), 0.3, 1e-12);
  const auto flipped = cap_rise(Force{{0.0, 0.0, -2.0}}, Force{{0.0, 0.0, 2.0}}, 0.3);
  EXPECT_TRUE(flipped.limited);
  EXPECT_NEAR(flipped.force_N.v.z, -0.3, 1e-12);
}

TEST(RiseCap, TakesNoWholeForceInTicksThatAreMuchShorterThanThePeriod) {
  // A force of 3.7 N that a late tick turned by 8 degrees, and three ticks of a tenth of the period.
  const Force wanted{{3.7 * std::sin(0.14), 0.0, 3.7 * std::cos(0.14)}}, velocity{{-0.3, 0.0, 0.02}};
  const auto left_N = [&](double most_lost) {
    Force force{{-0.3, 0.0, 3.69}};
    for (int n = 0; n < 3; ++n) force = cap_rise(wanted, force, 0.03, velocity, most_lost).force_N;
    return norm(force);
  };
  EXPECT_LT(left_N(1.0), 1.5);
  EXPECT_GT(left_N(0.1), 0.7 * 3.7);
}

TEST(RiseCap, LetsAPushEndAtOnceWhereTheForceTurns) {
  // The law begins to brake a hand that it pushed until now. The new force may only grow slowly; what is kept
  // of the old one would push the hand on with 0.45 W.
  const Force wanted{{0.75, 0.0, 1.3}}, before{{1.5, 0.0, 0.0}}, velocity{{1.0, 0.0, -1.0}};
  ASSERT_LT(dot(wanted, velocity), 0.0);
  EXPECT_NEAR(dot(cap_rise(wanted, before, 0.3).force_N, velocity), 0.45, 1e-12);
  EXPECT_NEAR(dot(cap_rise(wanted, before, 0.3, velocity).force_N, velocity), 0.0, 1e-12);
}

TEST(RiseCap, LeavesTheForceOfAHandThatMovesAcrossIt) {
  // A hand swings about the place that holds it: the law's force is larger than the last one, and its power
  // is nearly zero. The last force, one tick behind, would push with 0.02 W.
  constexpr double kAngle = 0.018;
  const Force velocity{{0.2, 0.0, 0.0}}, before{{3.7 * std::sin(kAngle), 0.0, 3.7 * std::cos(kAngle)}},
      wanted{{0.0, 0.0, 5.5}};
  const auto risen = cap_rise(wanted, before, 0.3, velocity);
  ASSERT_TRUE(risen.limited);
  EXPECT_LE(dot(risen.force_N, velocity), 1e-12);
  EXPECT_GT(norm(risen.force_N), 3.95);
  EXPECT_FALSE(cap_rise(risen.force_N, before, 0.3 + 1e-9).limited) << "the new part is within the limit";
}

TEST(RiseCap, GivesAMovingHandNoMorePowerThanTheWantedForce) {
  std::mt19937 random(5);
  std::normal_distribution<double> side;
  const auto any = [&] { return Force{{side(random), side(random), side(random)}}; };
  int reduced = 0;
  for (int k = 0; k < 20000; ++k) {
    const Force wanted = any(), before = any(), velocity = any();
    const double most = 0.3 * std::abs(side(random));
    const Force plain = cap_rise(wanted, before, most).force_N;
    const Force risen = cap_rise(wanted, before, most, velocity).force_N;
    if (!cap_rise(wanted, before, most).limited) {
      EXPECT_EQ(risen, wanted);
      continue;
    }
    EXPECT_LE(dot(risen, velocity), std::max(0.0, dot(wanted, velocity)) + 1e-12);
    // It is still no step above the limit, no pull, and no longer.
    EXPECT_LE(norm(cap_rise(risen, before, most).force_N - risen), 1e-12);
    EXPECT_GE(dot(risen, wanted), -1e-12);
    EXPECT_LE(norm(risen), norm(plain) + 1e-12);
    reduced += norm(plain - risen) > 1e-6 ? 1 : 0;
  }
  EXPECT_GT(reduced, 1000);
}

TEST(Ramp, FallsAndRisesInItsTimesAndStopsAtItsEnds) {
  Ramp ramp(0.02, 0.25);
  EXPECT_EQ(ramp.value(), 0.0);
  for (int i = 0; i < 125; ++i) ramp.step(true, 0.001);
  EXPECT_NEAR(ramp.value(), 0.5, 1e-9);
  for (int i = 0; i < 500; ++i) ramp.step(true, 0.001);
  EXPECT_EQ(ramp.value(), 1.0);
  for (int i = 0; i < 10; ++i) ramp.step(false, 0.001);
  EXPECT_NEAR(ramp.value(), 0.5, 1e-9);
  for (int i = 0; i < 500; ++i) ramp.step(false, 0.001);
  EXPECT_EQ(ramp.value(), 0.0);
}

}  // namespace
}  // namespace palpable::haptics
