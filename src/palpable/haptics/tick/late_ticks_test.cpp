// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Touches as a busy machine makes them: many ticks come late, the next one then early, some after a stall,
// and the scene changes meanwhile. A simulated hand moves by one tick's way in each of them, however long it
// was, so that in a short one its damper may cancel the whole spring.
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/law/test_scenes.hpp"
#include "palpable/haptics/safety/stability.hpp"
#include "palpable/haptics/servo/start_touch.hpp"
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// When the ticks of a loop come whose deadlines are `late_share` of the time late by about a tick, and a
/// tenth as often by up to 60 ms.
class BusyClock {
 public:
  BusyClock(double late_share, unsigned seed) : late_share_(late_share), random_(seed) {}

  /// The length of the next tick: at least a tenth of the nominal one, as ServoLoop's.
  double next_s() {
    const double deadline_s = kT_s * (std::floor(now_s_ / kT_s) + 1.0);
    const double kind = share();
    double late_s = 0.02 * kT_s * share();
    if (kind < late_share_) late_s = -kT_s * std::log(1.0 - share());
    if (kind < 0.1 * late_share_) late_s = 60.0 * kT_s * share() * share();
    const double length_s = std::max(0.1 * kT_s, deadline_s + late_s - now_s_);
    now_s_ += length_s;
    return length_s;
  }
  double share() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_); }

 private:
  double late_share_;
  std::mt19937 random_;
  double now_s_ = 0.0;
};

models::Scene waves(double height_m) {
  Raster<float> z(100, 80);
  for (int y = 0; y < z.height(); ++y)
    for (int x = 0; x < z.width(); ++x)
      z(x, y) = static_cast<float>(0.5 * height_m * (1.0 + std::sin(0.15 * x) * std::cos(0.11 * y)));
  models::Scene scene = scene_of(std::move(z), 0.001);
  models::Material material;
  material.texture.kind = models::TouchTexture::Kind::bumps;
  material.texture.pitch_m = 0.002;
  material.texture.height_m = 0.0001;
  scene.materials = {material};
  return scene;
}

/// J: what the hand received beyond what it gave in a contact, and what the recording's numbers say of that.
struct Made {
  double received_J = 0.0;
  /// What the change of scene brought: hills that come up under a hand lift it.
  double changes_J = 0.0;
  double shown_J = 0.0;
  double bound_J = 0.0;
  std::uint64_t stalls = 0;
};

/// A stroke of two seconds. The scene changes at a random instant, and a stall comes up to 20 ticks before it
/// or 40 after it.
Made touched(double friction, double late_share, unsigned seed) {
  BusyClock clock(late_share, seed);
  device::HandOptions options;
  options.delay_samples = 1;
  options.script.speed_m_per_s = 0.2;
  options.script.seed = seed;
  if (seed % 2 == 0) options.script.kind = device::HandScriptOptions::Kind::random;
  CountedHand hand(options);
  const SafeContact safe = safe_contact(hand.traits(), options.rate_hz, 2.0, 1000.0, 0.5);
  LawParameters law;
  law.stiffness_N_per_m = safe.stiffness_N_per_m;
  law.damping_Ns_per_m = safe.damping_Ns_per_m;
  law.static_friction = friction;
  std::array<HapticScene, 2> scenes;
  for (unsigned k = 0; k < 2; ++k) {
    const models::Scene scene = waves(k == 0 ? 0.010 : 0.012);
    scenes[k] = {made(scene, law), fit_workspace(scene, hand.traits()), k + 1};
  }
  Ring<TouchEvent> events(1024);
  TickPipeline tick(hand, scenes[0], {}, events);
  const int change = 30 + static_cast<int>(1400 * clock.share());
  const int stall = change - 20 + static_cast<int>(60 * clock.share());
  double t_s = 0.0;
  for (int n = 0; n < 2000; ++n) {
    if (n == change) tick.change(scenes[1]);
    const double dt_s = n == stall ? 0.006 + 0.054 * clock.share() : clock.next_s();
    if (dt_s > TickOptions{}.stall_s) {
      hand.cut();
      tick.note_cut_force();
    }
    if (!tick.step(t_s += dt_s, dt_s).has(flag::kContact)) hand.in_free_air();
    while (events.take()) {
    }
  }
  const TickCounts& counts = tick.counts();
  return {hand.most_J(), counts.scene_change_J, counts.work_made_max_J, counts.work_since_zero_force_max_J,
          counts.stalls};
}

class LateTicks : public testing::TestWithParam<double> {};

TEST_P(LateTicks, MakeNoEnergyNeitherForTheHandNorByTheNumbersOfARecording) {
  const double friction = GetParam();
  std::uint64_t stalls = 0;
  int above = 0;
  for (const double late_share : {0.05, 0.2, 0.5})
    for (unsigned seed = 1; seed <= 25; ++seed) {
      const Made made = touched(friction, late_share, seed);
      const double received_J = made.received_J - made.changes_J;
      EXPECT_LE(received_J, friction > 0.0 ? 1e-6 : 1.1e-4) << "seed " << seed << ", late " << late_share;
      above += received_J > 1e-6 ? 1 : 0;
      EXPECT_LE(made.shown_J, 5e-6) << "seed " << seed << ", late " << late_share;
      EXPECT_LE(made.shown_J, made.bound_J * (1.0 + 1e-12)) << "seed " << seed << ", late " << late_share;
      stalls += made.stalls;
    }
  EXPECT_GT(stalls, 500U);
  // Without friction about one of a hundred hands (docs/history).
  EXPECT_LE(above, 2);
}

INSTANTIATE_TEST_SUITE_P(Frictions, LateTicks, testing::Values(0.0, 0.1, 0.5));

}  // namespace
}  // namespace palpable::haptics
