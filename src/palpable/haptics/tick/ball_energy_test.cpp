// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// The energy that `proxy` returns to a hand that explores rough ground with a ball: creases nearly
// everywhere.
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// What a hand receives in a contact beyond what it gave, exploring rough ground with a ball for ten seconds.
double received_by_ball_J(const device::HandOptions& options, double friction, unsigned seed,
                          double* contact) {
  CountedHand hand(options);
  const SafeContact safe = safe_contact(hand.traits(), options.rate_hz, 1.0, 1e5, 0.5);
  // So few pixels that all creases are refined.
  Raster<float> z = random_hills(70, 55, seed);
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> grain(0.0F, 1.5e-4F);
  for (float& height : z.values()) height += grain(random);
  LawParameters p;
  p.radius_m = 0.001;
  p.stiffness_N_per_m = safe.stiffness_N_per_m;
  p.damping_Ns_per_m = safe.damping_Ns_per_m;
  p.static_friction = friction;
  HapticScene scene;
  scene.touchable = made(scene_of(std::move(z), 0.0005), p);
  TickOptions observed;
  observed.passivity = Passivity::observe;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, scene, observed, events);
  constexpr int kTicks = 10000;
  for (int n = 0; n < kTicks; ++n) {
    if (!tick.step(0.001 * n, 0.001).has(flag::kContact)) hand.in_free_air();
    while (events.take()) {
    }
  }
  *contact += static_cast<double>(tick.counts().contact_ticks) / kTicks;
  return hand.most_J();
}

TEST(EnergyOfABall, IsNotMadeOnRoughGround) {
  Hands hands(5);
  double contact = 0.0;
  constexpr unsigned kHands = 8;
  for (unsigned k = 1; k <= kHands; ++k) {
    device::HandOptions options = hands.next();
    options.resolution_m = hands.uniform(1e-6, 2e-5);
    options.script.kind = device::HandScriptOptions::Kind::random;
    options.script.workspace_m = {0.04, 0.03, 0.03};
    options.script.seed = k;
    options.script.speed_m_per_s = hands.uniform(0.03, 0.3);
    EXPECT_LE(received_by_ball_J(options, k % 2 == 0 ? 0.3 : 0.0, k, &contact), 1e-6) << "hand " << k;
  }
  EXPECT_GT(contact, 0.3 * kHands);
}

}  // namespace
}  // namespace palpable::haptics
