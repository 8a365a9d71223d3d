// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// A hand that is in contact when its touch, or its force after a pause, begins: the ramp loads the spring.
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/safety/test_hands.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/test_loop.hpp"

#include <algorithm>
#include <cmath>
#include <list>
#include <memory>
#include <random>
#include <utility>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kLoaded_N_per_m = 500.0, kSensorStep_m = 1e-5, kPressed_m = 0.00475;

/// A hand of a sensor with steps of 10 um, where a test puts it, on a plane at 0.
struct Begun {
  explicit Begun(double depth_m, std::shared_ptr<const Touchable> touchable = plane(kLoaded_N_per_m),
                 const TickOptions& options = {}) {
    loop.device.mutable_traits().position_resolution_m = kSensorStep_m;
    loop.program.touchable = std::move(touchable);
    loop.tick = std::make_unique<TickPipeline>(loop.device, loop.program, options, loop.events);
    move_to(-depth_m, 0);
  }
  double move_to(double z_m, int ticks = 1) {
    loop.device.reading.position.v.z = kSensorStep_m * std::round(z_m / kSensorStep_m);
    loop.run(ticks);
    return ticks > 0 ? loop.written().z : 0.0;
  }
  Loop loop{plane(kLoaded_N_per_m)};
};

TEST(LoadedSpring, KeepsItsForceWhereAReadingGoesOutByAStep) {
  Begun hand(kPressed_m);
  EXPECT_NEAR(hand.move_to(-kPressed_m, 1000), kLoaded_N_per_m * kPressed_m, 1e-9);
  // Before, 2.375 N became 0 in this tick.
  EXPECT_NEAR(hand.move_to(-kPressed_m + kSensorStep_m), kLoaded_N_per_m * kPressed_m, 0.01);
  EXPECT_NEAR(hand.move_to(-kPressed_m + kSensorStep_m, 300), kLoaded_N_per_m * kPressed_m, 0.01);
}

TEST(LoadedSpring, PushesAHandUntilItHasLeftTheSurface) {
  // A damper takes what a held force gives too much.
  Begun hand(kPressed_m, std::make_shared<SpringSurface>(flat, kLoaded_N_per_m, 1.0));
  hand.move_to(-kPressed_m, 1000);
  for (double depth_m = kPressed_m; depth_m > 0.0; depth_m -= 2e-5)
    EXPECT_NEAR(hand.move_to(-depth_m), kLoaded_N_per_m * depth_m, 0.03) << depth_m;
  EXPECT_EQ(hand.move_to(1e-4), 0.0);
  const TickCounts& counts = hand.loop.tick->counts();
  const double stored_J = 0.5 * kLoaded_N_per_m * kPressed_m * kPressed_m;
  EXPECT_NEAR(counts.scene_change_J, stored_J, 0.01 * stored_J);
  EXPECT_LE(counts.made_max_J, 1e-6);
}

TEST(LoadedSpring, RisesUnderTheHandNoFasterThanAnotherSurface) {
  Begun hand(0.015);
  double before_N = hand.move_to(-0.015);
  int rises = 0;
  for (int n = 1; n < 1000; ++n) {
    const double now_N = hand.move_to(-0.015);
    // The cap of 3 N is 6 mm deep.
    EXPECT_LE(now_N - before_N, kLoaded_N_per_m * kLift_m_per_s * kT_s) << n;
    rises += now_N > before_N ? 1 : 0;
    before_N = now_N;
  }
  EXPECT_NEAR(before_N, 3.0, 1e-9);
  EXPECT_GT(rises, 400);
}

// The account that begins with the touch, and the hand's own.
TEST(LoadedSpring, GivesAHandNoMoreThanTheRampBroughtAndTheHandPutIn) {
  Hands hands(17);
  double most_J = 0.0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    device::HandOptions options = hands.next();
    options.script.kind = device::HandScriptOptions::Kind::hold;
    // Within a step of the sensor, the depth in which the touch begins is not known.
    options.resolution_m = 1e-7;
    CountedHand hand(options);
    const SafeContact safe = safe_contact(hand.traits(), options.rate_hz, 1.0, 1e5, 0.5);
    const HapticScene scene{
        std::make_shared<SpringSurface>(flat, safe.stiffness_N_per_m, safe.damping_Ns_per_m), {}, 1};
    Ring<TouchEvent> events(64);
    TickPipeline tick(hand, scene, {}, events);
    double goal_m = -hands.uniform(0.0005, 0.008), next_m = goal_m;
    hand.place({0.0, 0.0, goal_m});
    const bool stalls = seed % 2 == 0;
    double beyond_J = 0.0, t_s = 0.0;
    for (int n = 0; n < 6000; ++n) {
      if (n % 500 == 20) next_m = hands.uniform(-0.01, 0.003);
      hand.set_goal({0.0, 0.0, goal_m += std::clamp(next_m - goal_m, -1e-4, 1e-4)});
      tick.set_paused(n % 2000 > 1600 && n % 2000 < 1800);
      const int late = stalls && random() % 500 == 0 ? 12 : 1;
      hand.stall(late);
      if (late > 1) tick.note_cut_force();
      tick.step(t_s += kT_s * late, kT_s * late);
      beyond_J = std::max(beyond_J, hand.total_J() - tick.counts().scene_change_J);
    }
    EXPECT_LE(beyond_J, 1e-6) << "hand " << seed;
    // In a stall, the account counts what a hand could have received.
    EXPECT_LE(tick.counts().made_max_J, stalls ? 5e-5 : 1e-6) << "hand " << seed;
    most_J = std::max(most_J, tick.counts().scene_change_J);
  }
  EXPECT_GT(most_J, 1e-4);
}

TEST(LoadedSpring, CarriesAHandThatEnteredDuringAPause) {
  Begun hand(-0.001);
  hand.move_to(0.001, 100);
  hand.loop.tick->set_paused(true);
  hand.move_to(0.001, 50);
  for (double z_m = 0.001; z_m > -kPressed_m; z_m -= 1e-4) hand.move_to(z_m);
  hand.loop.tick->set_paused(false);
  EXPECT_LT(hand.move_to(-kPressed_m), 0.05);
  hand.move_to(-kPressed_m, 500);
  EXPECT_NEAR(hand.move_to(-kPressed_m + kSensorStep_m), kLoaded_N_per_m * kPressed_m, 0.01);
  EXPECT_LE(hand.loop.tick->counts().made_max_J, 1e-6);
}

TEST(LoadedSpring, IsNotLoadedByARampThatFollowsAStall) {
  Begun hand(-0.001);
  hand.move_to(0.001, 100);
  for (double z_m = 0.001; z_m > -kPressed_m; z_m -= 2e-5) hand.move_to(z_m);
  hand.loop.tick->note_cut_force();
  hand.move_to(-kPressed_m - 0.001, 500);
  EXPECT_EQ(hand.loop.tick->counts().scene_change_J, 0.0);
}

/// A hand that is in contact from the first tick on, and a plate that rises by 0.8 mm in each of ten
/// pictures.
TEST(LoadedSpring, HoldsAHandAboveAPlateThatGoesOnRising) {
  const auto plate = [](double z_m) {
    LawParameters p = frictionless();
    p.stiffness_N_per_m = 300.0;
    p.damping_Ns_per_m = 1.5;
    return made(scene_of(Raster<float>(100, 80, static_cast<float>(z_m))), p);
  };
  device::HandOptions options;
  options.script.kind = device::HandScriptOptions::Kind::hold;
  options.max_force_N = 8.0;
  CountedHand hand(options);
  std::list<HapticScene> scenes{{plate(0.005), {}, 1}};
  TickOptions of_pictures;
  of_pictures.fade_s = 0.03;
  Ring<TouchEvent> events(64);
  TickPipeline tick(hand, scenes.front(), of_pictures, events);
  const double held_m = 0.003;
  hand.place({0.0, 0.0, held_m});
  hand.set_goal({0.0, 0.0, held_m});
  double plate_m = 0.005;
  for (int n = 0; n < 1500; ++n) {
    if (n >= 600 && n < 930 && n % 33 == 0) {
      scenes.push_back({plate(plate_m += 0.0008), {}, static_cast<std::uint32_t>(n), {}, Succession::moves});
      tick.change(scenes.back());
    }
    const TouchSample& sample = tick.step(kT_s * n, kT_s);
    if (n < 500) continue;
    EXPECT_TRUE(sample.has(flag::kContact)) << n;
    const double due_N = 300.0 * (sample.proxy.v.z - sample.position.v.z);
    // Its damper acts on a hand that it lifts.
    EXPECT_NEAR(sample.written_force_N.v.z, due_N, 0.1 * due_N + 0.04) << n;
  }
  // It loads the spring further, and lifts the hand.
  EXPECT_GT(tick.counts().scene_change_J, 2e-3);
  EXPECT_LE(hand.total_J(), tick.counts().scene_change_J + 1e-6);
  EXPECT_LE(tick.counts().made_max_without_controller_J, 1e-6);
}

}  // namespace
}  // namespace palpable::haptics
