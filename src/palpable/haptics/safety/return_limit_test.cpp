// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/return_limit.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// What a spring stores that keeps whatever it is given.
constexpr double kDeep_J = 1.0;

ReturnLimit after_giving(double given_J) {
  ReturnLimit limit;
  limit.begin();
  limit.account(-given_J, kDeep_J);
  return limit;
}

TEST(ReturnLimit, LeavesAForceAgainstTheMovementAndAtRest) {
  const ReturnLimit limit = after_giving(0.0);
  EXPECT_EQ(limit.share({.power_W = -0.5, .force_N = 3.0, .mass_kg = 0.1}), 1.0);
  EXPECT_EQ(limit.share({.power_W = 0.0, .force_N = 3.0, .mass_kg = 0.1}), 1.0);
}

TEST(ReturnLimit, LeavesAForceThatReturnsWhatWasGiven) {
  // 0.2 N along a hand at 0.2 m/s return 40 uJ in a tick, and 0.2 uJ more to a mass of 0.1 kg at most.
  EXPECT_EQ(after_giving(41e-6).share({.power_W = 0.04, .force_N = 0.2, .mass_kg = 0.1}), 1.0);
  EXPECT_LT(after_giving(39e-6).share({.power_W = 0.04, .force_N = 0.2, .mass_kg = 0.1}), 1.0);
}

TEST(ReturnLimit, ReturnsNoMoreThanWasGivenAndIsNotOnTheWay) {
  constexpr double kTick_s = 0.001, kForce_N = 2.0, kMass_kg = 0.05;
  for (const double given_J : {0.0, 1e-6, 20e-6, 80e-6})
    for (const double power_W : {0.02, 0.1, 0.5})
      for (const double on_the_way_J : {0.0, 15e-6}) {
        const double share =
            after_giving(given_J).share({power_W, kForce_N, on_the_way_J, 0.0, kTick_s, kMass_kg});
        const double gained_Ns = share * kForce_N * kTick_s;
        const double returned_J = share * power_W * kTick_s + 0.5 * gained_Ns * gained_Ns / kMass_kg;
        EXPECT_LE(returned_J, std::max(0.0, given_J - on_the_way_J) + 1.0001e-7);
        EXPECT_TRUE(share == 1.0 || returned_J >= given_J - on_the_way_J) << "no weaker than necessary";
      }
}

TEST(ReturnLimit, HoldsInALongContact) {
  ReturnLimit limit;
  limit.begin();
  for (int n = 0; n < 1000; ++n) limit.account(0.0, kDeep_J);
  EXPECT_LT(limit.share({.power_W = 0.5, .force_N = 3.0, .mass_kg = 0.1}), 0.01);
}

TEST(ReturnLimit, ReturnsNoMoreThanTheSpringHasKept) {
  ReturnLimit limit = after_giving(50e-6);
  // The proxy slips off the bump; the hand presses into the next one.
  limit.account(0.0, 5e-6);
  EXPECT_NEAR(limit.given_J(), 5e-6, 1e-18);
  limit.account(-2e-6, kDeep_J);
  EXPECT_NEAR(limit.given_J(), 7e-6, 1e-18);
  const ReturnLimit::Sending sending{.power_W = 0.006, .force_N = 0.1};
  EXPECT_EQ(limit.share(sending), 1.0);
  ReturnLimit::Sending unsure = sending;
  unsure.unsure_J = 3e-6;
  EXPECT_LT(limit.share(unsure), 0.7);
}

TEST(ReturnLimit, CountsWhatItReturnedAndBeginsAnew) {
  ReturnLimit limit = after_giving(50e-6);
  limit.account(30e-6, kDeep_J);
  EXPECT_NEAR(limit.given_J(), 20e-6, 1e-18);
  limit.raise_to(10e-6);
  EXPECT_NEAR(limit.given_J(), 20e-6, 1e-18);
  limit.begin();
  EXPECT_EQ(limit.given_J(), 0.0);
}

}  // namespace
}  // namespace palpable::haptics
