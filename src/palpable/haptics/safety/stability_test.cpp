// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/stability.hpp"

#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/test_tapping_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

device::Traits known() {
  device::Traits traits;
  traits.damping_Ns_per_m = 0.1;
  traits.coulomb_friction_N = 0.05;
  traits.position_resolution_m = 10e-6;
  return traits;
}

TEST(SafeContact, DoesNotChangeASoftWall) {
  const auto safe = safe_contact(known(), 1000.0, 1.0, 500.0, 0.5);
  EXPECT_EQ(safe.stiffness_N_per_m, 500.0);
  EXPECT_EQ(safe.damping_Ns_per_m, 0.5);
  EXPECT_EQ(safe.bound, StiffnessBound::none);
  EXPECT_TRUE(reason(safe.bound).empty());
}

TEST(SafeContact, GivesAWallTheDampingThatItNeeds) {
  // (2d + 1)·K·T/2 from 66 % of it.
  const auto safe = safe_contact(known(), 1000.0, 1.0, 500.0, 0.0);
  EXPECT_EQ(safe.stiffness_N_per_m, 500.0);
  EXPECT_NEAR(safe.damping_Ns_per_m, 0.25 / 0.66, 1e-12);
}

TEST(SafeContact, CountsTheDelayAndTheRate) {
  // Device and hand have a damping of 1.6 N·s/m; the wall may add at most 0.55 of that.
  device::Traits traits = known();
  EXPECT_NEAR(safe_contact(traits, 1000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, 0.66 * 1.1 * 1600.0, 1e-9);
  traits.delay_samples = 2;
  EXPECT_NEAR(safe_contact(traits, 1000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, 0.66 * 1.1 * 320.0, 1e-9);
  EXPECT_NEAR(safe_contact(traits, 4000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, 0.66 * 1.1 * 1280.0, 1e-9);
  EXPECT_NE(safe_contact(traits, 4000.0, 1.0, 1e6, 0.5).bound, StiffnessBound::none);
}

TEST(SafeContact, CountsThePeriodOfASensorThatIsSlowerThanTheLoop) {
  device::Traits traits = known();
  const double of_the_loop = safe_contact(traits, 1000.0, 1.0, 1e6, 0.5).stiffness_N_per_m;
  traits.sensor_period_s = 0.001;
  EXPECT_EQ(safe_contact(traits, 1000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, of_the_loop);
  // 250 Hz, not in step with the loop: held for 4 ms and read half a tick late.
  traits.sensor_period_s = 0.004;
  EXPECT_NEAR(safe_contact(traits, 1000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, 0.85 * of_the_loop / 5.0, 1e-9);
  EXPECT_NEAR(safe_contact(traits, 4000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, 0.85 * of_the_loop / 4.25, 1e-9);
  traits.delay_samples = 2;
  EXPECT_NEAR(safe_contact(traits, 1000.0, 1.0, 1e6, 0.5).stiffness_N_per_m, 0.85 * of_the_loop / 9.0, 1e-9);
}

TEST(SafeContact, LowersADampingThatTheDeviceCannotRender) {
  const auto safe = safe_contact(known(), 1000.0, 1.0, 300.0, 50.0);
  EXPECT_NEAR(safe.damping_Ns_per_m, 0.55 * 1.6, 1e-12);
  EXPECT_EQ(safe.stiffness_N_per_m, 300.0);
}

TEST(SafeContact, KeepsTheSensorsStepsBelowWhatFrictionHolds) {
  device::Traits traits = known();
  traits.position_resolution_m = 0.5e-3;
  const auto safe = safe_contact(traits, 1000.0, 1.0, 500.0, 0.5);
  EXPECT_NEAR(safe.stiffness_N_per_m, 0.9 * 200.0, 1e-9);
  EXPECT_EQ(safe.bound, StiffnessBound::quantisation);
}

TEST(SafeContact, AccountsForTheScaleOfTheScene) {
  // A scene of 0.5 m is mapped to a device workspace of 0.1 m: there, stiffness and damping are five times as
  // large.
  const auto safe = safe_contact(known(), 1000.0, 5.0, 1e6, 0.1);
  EXPECT_NEAR(safe.stiffness_N_per_m, 0.66 * 1.1 * 320.0, 1e-9);
}

TEST(SafeContact, LimitsNothingWithoutMotors) {
  device::Traits traits = known();
  traits.pushes_back = false;
  EXPECT_EQ(safe_contact(traits, 1000.0, 1.0, 1e5, 9.0).stiffness_N_per_m, 1e5);
}

TEST(SafeContact, ComesToRestInEveryTestedHand) {
  Hands hands(11);
  for (int round = 0; round < 60; ++round) {
    device::HandOptions hand = hands.next();
    hand.script.kind = device::HandScriptOptions::Kind::hold;
    device::SimulatedHand simulated(hand);
    const auto safe = safe_contact(simulated.traits(), hand.rate_hz, 1.0, hands.uniform(100.0, 5000.0),
                                   hands.uniform(0.0, 2.0));
    HapticScene program;
    program.touchable = std::make_shared<SpringSurface>(flat, safe.stiffness_N_per_m, safe.damping_Ns_per_m);
    TickOptions options;
    options.passivity = Passivity::observe;
    Ring<TouchEvent> events(1024);
    TickPipeline tick(simulated, program, options, events);
    simulated.place({0.0, 0.0, 0.002});
    simulated.set_goal({0.0, 0.0, -0.006});
    double least_m = 1.0;
    double most_m = -1.0;
    for (int n = 0; n < 3000; ++n) {
      tick.step(0.001 * n, 0.001);
      const double z = simulated.true_position_m().z;
      if (n < 2000) continue;
      least_m = std::min(least_m, z);
      most_m = std::max(most_m, z);
    }
    EXPECT_GT(tick.counts().contact_ticks, 2000U);
    EXPECT_LE(most_m - least_m, std::max(10e-6, hand.resolution_m))
        << "round " << round << " delay " << hand.delay_samples << " K " << safe.stiffness_N_per_m;
  }
}

/// Of devices drawn from `seed` with sensors of up to that period: how many received more than 1 uJ at the
/// computed limit, and how many at `share` of it.
struct Received {
  int at_limit = 0;
  int above = 0;
};

Received received(int devices, std::uint64_t seed, double slowest_sensor_s, double seconds, double share) {
  constexpr double kAllowed_J = 1e-6;
  std::mt19937_64 random(seed);
  Received counts;
  for (int n = 0; n < devices; ++n) {
    const auto hand = random_device(random, slowest_sensor_s);
    const auto wall = stiffest_wall(hand);
    const std::uint64_t tapping = random();
    const auto receives = [&](double of_limit) {
      return most_received_J(hand, of_limit * wall.stiffness_N_per_m, wall.damping_Ns_per_m, seconds,
                             tapping) > kAllowed_J;
    };
    counts.at_limit += receives(1.0) ? 1 : 0;
    counts.above += receives(share) ? 1 : 0;
  }
  return counts;
}

TEST(SafeContact, AWallAtTheLimitReturnsNoMoreThanAHandThatTapsItGave) {
  const auto found = received(40, 5, 0.0, 15.0, 1.6);
  EXPECT_EQ(found.at_limit, 0);
  // Nor is the limit far too low.
  EXPECT_EQ(found.above, 40);
}

TEST(SafeContact, AWallAtTheLimitOfASlowSensorReturnsNoMoreThanAHandThatTapsItGave) {
  const auto found = received(16, 21, 0.010, 9.0, 2.0);
  EXPECT_EQ(found.at_limit, 0);
  EXPECT_GE(found.above, 14);
}

}  // namespace
}  // namespace palpable::haptics
