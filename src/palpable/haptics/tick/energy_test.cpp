// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The energy that the laws generate with different hands, at the stiffness limit and far above it. The limit
// on growing forces is active, the passivity controller is off.
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <string>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// The greatest energy generated without the controller while a hand explores for five seconds.
double made_by(Law law, const device::HandOptions& options, double times_the_limit, double* contact_share) {
  device::SimulatedHand hand(options);
  models::Scene scene = scene_of(random_hills(200, 160, 5));
  const auto safe = safe_contact(hand.traits(), options.rate_hz, 1.0, 1e5, 0.5);
  LawParameters parameters;
  parameters.law = law;
  if (description_of(law).is_contact) {
    parameters.stiffness_N_per_m = times_the_limit * safe.stiffness_N_per_m;
    parameters.damping_Ns_per_m = safe.damping_Ns_per_m;
  }
  HapticScene program;
  program.touchable = made(scene, parameters);
  TickOptions observed;
  observed.passivity = Passivity::observe;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, program, observed, events);
  constexpr int kTicks = 5000;
  for (int n = 0; n < kTicks; ++n) {
    tick.step(0.001 * n, 0.001);
    while (events.take()) {
    }
  }
  *contact_share = static_cast<double>(tick.counts().contact_ticks) / kTicks;
  return tick.counts().made_max_without_controller_J;
}

class EnergyOf : public testing::TestWithParam<Law> {};

TEST_P(EnergyOf, IsGeneratedFarAboveTheStiffnessLimitButNotAtIt) {
  Hands hands(17);
  double most_above_J = 0.0;
  for (int round = 0; round < 6; ++round) {
    device::HandOptions hand = hands.next();
    hand.script.kind = device::HandScriptOptions::Kind::random;
    hand.script.workspace_m = {0.04, 0.03, 0.03};
    hand.script.seed = static_cast<std::uint64_t>(round) + 1;
    double contact = 0.0;
    EXPECT_LE(made_by(GetParam(), hand, 1.0, &contact), 1e-6)
        << "round " << round << " delay " << hand.delay_samples;
    EXPECT_GT(contact, 0.3);
    most_above_J = std::max(most_above_J, made_by(GetParam(), hand, 5.0, &contact));
  }
  EXPECT_GT(most_above_J, 1e-5) << "the account sees what there is to see";
}

TEST(EnergyOfRolling, IsNotGeneratedAtBendsForAnyDelay) {
  Hands hands(17);
  double most_J = 0.0;
  for (int round = 0; round < 12; ++round) {
    device::HandOptions hand = hands.next();
    hand.script.kind = device::HandScriptOptions::Kind::random;
    hand.script.workspace_m = {0.04, 0.03, 0.03};
    hand.script.seed = static_cast<std::uint64_t>(round) + 1;
    double contact = 0.0;
    most_J = std::max(most_J, made_by(Law::rolling, hand, 1.0, &contact));
  }
  // An earlier version used the slope directly below the hand and generated 560 uJ at a delay of two ticks.
  EXPECT_LE(most_J, 2e-6);
}

INSTANTIATE_TEST_SUITE_P(Laws, EnergyOf, testing::Values(Law::proxy, Law::penalty),
                         [](const auto& law) { return std::string(name_of(law.param)); });

}  // namespace
}  // namespace palpable::haptics
