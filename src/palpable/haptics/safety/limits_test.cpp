// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/limits.hpp"

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

TEST(ForceCap, ShortensAlongTheForceAndSaysSo) {
  const Limited capped = cap_force({3.0, 0.0, 4.0}, 2.5);
  EXPECT_TRUE(capped.limited);
  EXPECT_NEAR(capped.force_N.x, 1.5, 1e-12);
  EXPECT_NEAR(capped.force_N.z, 2.0, 1e-12);
  EXPECT_FALSE(cap_force({3.0, 0.0, 4.0}, 5.0).limited);
}

TEST(RiseCap, NeverDelaysARelease) {
  const Limited released = cap_rise({0.0, 0.0, 0.1}, {0.0, 0.0, 3.0}, 0.3);
  EXPECT_FALSE(released.limited);
  EXPECT_EQ(released.force_N, (Vec3{0.0, 0.0, 0.1}));
}

TEST(RiseCap, LetsTheForceGrowByNoMoreThanAllowed) {
  const Limited risen = cap_rise({0.0, 0.0, 3.0}, {0.0, 0.0, 1.0}, 0.3);
  EXPECT_TRUE(risen.limited);
  EXPECT_NEAR(risen.force_N.z, 1.3, 1e-12);
}

TEST(RiseCap, LimitsATurnAtConstantSizeAndALeapToTheOtherSide) {
  const Limited turned = cap_rise({1.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, 0.3);
  EXPECT_TRUE(turned.limited);
  EXPECT_NEAR(norm(turned.force_N), 0.3, 1e-12);
  const Limited flipped = cap_rise({0.0, 0.0, -2.0}, {0.0, 0.0, 2.0}, 0.3);
  EXPECT_TRUE(flipped.limited);
  EXPECT_NEAR(flipped.force_N.z, -0.3, 1e-12);
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
