// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/limits.hpp"

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
