// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/hand_measurement.hpp"

#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

Result<MeasuredHand> measured(device::HandOptions options) {
  options.script.kind = device::HandScriptOptions::Kind::hold;
  device::SimulatedHand hand(options);
  hand.place({});
  const PulseOptions pulses;
  const HapticScene scene{make_pulses(pulses, hand.traits()), {}, 1};
  Ring<TouchEvent> events(64);
  TickPipeline tick(hand, scene, TickOptions{}, events);
  std::vector<TouchSample> samples;
  constexpr double kPeriod_s = 0.001;
  for (int n = 0; n * kPeriod_s < pulses.duration_s(); ++n)
    samples.push_back(tick.step(n * kPeriod_s, kPeriod_s));
  return hand_of(samples, hand.traits(), pulses);
}

TEST(HandMeasurement, FindsTheDampingOfHandsOfEveryKind) {
  for (const double arm_damping : {1.5, 4.0, 12.0})
    for (const double arm_stiffness : {50.0, 400.0})
      for (const int delay : {0, 2}) {
        device::HandOptions options;
        options.arm_mass_kg = 0.2;
        options.arm_damping_Ns_per_m = arm_damping;
        options.arm_stiffness_N_per_m = arm_stiffness;
        options.delay_samples = delay;
        const auto hand = measured(options);
        ASSERT_TRUE(hand);
        EXPECT_NEAR(hand->median_damping_Ns_per_m, arm_damping, 0.1 * arm_damping + 0.1)
            << arm_damping << " " << arm_stiffness << " " << delay;
        EXPECT_NEAR(hand->together.mass_kg, 0.3, 0.03);
        EXPECT_LE(hand->least_damping_Ns_per_m, hand->median_damping_Ns_per_m);
        EXPECT_LE(hand->median_damping_Ns_per_m, hand->greatest_damping_Ns_per_m);
      }
}

TEST(HandMeasurement, UsesTheAxesThatADeviceHas) {
  device::HandOptions options;
  options.degrees_of_freedom = 2;
  const auto hand = measured(options);
  ASSERT_TRUE(hand);
  EXPECT_EQ(hand->pulses, 12);
}

TEST(HandMeasurement, DeterminesNothingOfAHandThatDoesNotMove) {
  const std::vector<PushedSample> still(200);
  EXPECT_FALSE(fit_impedance(still));
  EXPECT_FALSE(fit_impedance({}));
}

}  // namespace
}  // namespace palpable::haptics
