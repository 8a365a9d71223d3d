// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Fields behave like reliefs: friction without oscillation, borders of materials without a jump of the force,
// and textures below the stability limit.
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/stroke_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// Level ground on z = 0.
class Plate {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept { return {p.v.z, {{0.0, 0.0, 1.0}}}; }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return sizeof(*this); }
};

/// Amplitude of the oscillation of a hand along the ground in the last second of nine. The hand is held
/// beside the point where its proxy sticks.
double swing_m(const device::HandOptions& options, double stiffness_N_per_m, Passivity passivity) {
  device::SimulatedHand hand(options);
  const SafeContact safe = safe_contact(hand.traits(), options.rate_hz, 1.0, stiffness_N_per_m, 0.5);
  HapticScene scene;
  scene.touchable = std::make_shared<const SolidTouchable<Plate>>(
      MaterialMap({safe.stiffness_N_per_m, safe.damping_Ns_per_m, 1.0, 1.0}), 0.0);
  TickOptions limits;
  limits.passivity = passivity;
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, scene, limits, events);
  hand.place({0.0, 0.0, 0.001});
  hand.set_goal({0.0, 0.0, -0.010});
  double least_m = 1.0;
  double most_m = -1.0;
  for (int n = 0; n < 9000; ++n) {
    if (n == 1000) hand.set_goal({0.003, 0.0, -0.010});
    tick.step(0.001 * n, 0.001);
    while (events.take()) {
    }
    if (n < 8000) continue;
    least_m = std::min(least_m, hand.true_position_m().x);
    most_m = std::max(most_m, hand.true_position_m().x);
  }
  return most_m - least_m;
}

TEST(FieldTouch, DoesNotOscillateOnFrictionInALooseGrip) {
  device::HandOptions hand;
  hand.script.kind = device::HandScriptOptions::Kind::hold;
  hand.arm_mass_kg = 0.1;
  hand.arm_damping_Ns_per_m = 0.0;
  hand.arm_stiffness_N_per_m = 200.0;
  hand.device_friction_N = 0.0;
  for (const Passivity passivity : {Passivity::observe, Passivity::control})
    for (const int delay : {0, 1, 2}) {
      hand.delay_samples = delay;
      EXPECT_LE(swing_m(hand, 500.0, passivity), 20e-6)
          << "delay " << delay << " " << static_cast<int>(passivity);
    }
}

TEST(FieldTouch, ChangesMaterialsWithoutAForceStep) {
  std::array<Contact, 256> contacts{};
  contacts[0] = {1000.0, 0.0, 0.0, 0.0};
  contacts[1] = {200.0, 0.0, 0.0, 0.0};
  Raster<std::uint8_t> halves(2, 1, 0);
  halves(1, 0) = 1;
  const SolidTouchable<Plate> touchable(MaterialMap(contacts, halves, 0.04, 0.04), 0.0);
  TouchState state;
  Hand hand;
  Vec3 before_N;
  double greatest_N = 0.0;
  for (int k = 0; k < 400; ++k) {
    hand.position = {{-0.02 + 1e-4 * k, 0.0, k == 0 ? 0.001 : -0.003}};
    const Vec3 force_N = touchable.evaluate(hand, state).force_N.v;
    if (k > 1) greatest_N = std::max(greatest_N, norm(force_N - before_N));
    before_N = force_N;
  }
  EXPECT_NEAR(before_N.z, 0.6, 0.01);
  EXPECT_LE(greatest_N, 0.25) << "2.4 N between the two";
}

TEST(FieldTouch, StaysWithinTheStabilityLimitUnderATexture) {
  for (const auto kind : {models::TouchTexture::Kind::ridges, models::TouchTexture::Kind::grain,
                          models::TouchTexture::Kind::bumps}) {
    models::Material material;
    material.texture = {kind, 0.002, 1e-3, 0.0};
    const double most_N_per_m = kStrokeStiffness_N_per_m * texture_stiffening(material.texture);
    const SolidTouchable<Plate> touchable(MaterialMap({kStrokeStiffness_N_per_m, 0.0, 0.0, 0.0}), 0.0,
                                          Textures({material}));
    Hand hand;
    for (const double depth_m : {0.0002, 0.001, 0.002, 0.006}) {
      TouchState state;
      hand.position = {{0.0, 0.0, 0.001}};
      touchable.evaluate(hand, state);
      hand.position = {{0.0, 0.0, -depth_m}};
      for (int k = 0; k < 300; ++k) touchable.evaluate(hand, state);
      Vec3 before_N = touchable.evaluate(hand, state).force_N.v;
      constexpr double kStep_m = 5e-6;
      for (int k = 0; k < 800; ++k) {
        hand.position.v += Vec3{kStep_m, 0.0, 0.0};
        const Vec3 force_N = touchable.evaluate(hand, state).force_N.v;
        // Along the ground the force of a plain wall does not change.
        ASSERT_LE(std::abs(force_N.x - before_N.x),
                  1.05 * (most_N_per_m - kStrokeStiffness_N_per_m) * kStep_m + 1e-9)
            << depth_m;
        before_N = force_N;
      }
    }
  }
}

}  // namespace
}  // namespace palpable::haptics
