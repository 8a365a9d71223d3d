// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Pulls along a way, and vibrations after impacts, over a link.
#include "palpable/haptics/tick/test_pressing_hand.hpp"
#include "palpable/session/share/measured_remote_touch.hpp"

#include <cmath>
#include <iostream>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr Vec3 kWayBegins{-0.02, -0.01, 0.0}, kWayEnds{0.01, 0.01, 0.0};

models::Scene guided_scene() {
  models::Scene scene = flat_scene(100, 80);
  models::RouteGuide guide;
  guide.line_m = {{kWayBegins.x, kWayBegins.y}, {kWayEnds.x, kWayBegins.y}, {kWayEnds.x, kWayEnds.y}};
  guide.reach_m = 0.01;
  guide.ahead_m = 0.004;
  scene.guide = std::make_shared<const models::RouteGuide>(guide);
  return scene;
}

/// A hand that presses and does not steer, led over a link.
struct LedFromAfar {
  double from_the_end_m = 0.0;
  double made_J = 0.0;
  double max_growth_N = 0.0;
  /// Of the pull from that of the scene at the same places, and of the latter (RMS).
  double difference_N = 0.0;
  double pull_N = 0.0;
};

LedFromAfar led_from_afar(const LinkQuality& quality) {
  const models::Scene scene = guided_scene();
  TouchSettings settings;
  settings.law.static_friction = settings.law.dynamic_friction = 0.0;
  const auto traits = haptics::PressingHand({}).traits();
  const auto start =
      haptics::fit_workspace(scene, traits).inverse() * Point<SceneFrame>{kWayBegins + Vec3{0.0, 0.0, 0.002}};
  auto own = std::make_unique<haptics::PressingHand>(start.v);
  const haptics::PressingHand& hand = *own;
  RemoteBench bench(std::move(own), scene, settings, quality);
  const haptics::HapticScene& truth = bench.far_scene();
  haptics::TouchState state{};
  GreatestGrowth growth;
  double squares = 0.0, own_squares = 0.0, compared = 0.0;
  constexpr double kLeads_s = 8.0;
  while (bench.t_s() < kLeads_s) {
    const haptics::TouchSample& sample = bench.step();
    growth.take(sample.written_force_N.v);
    haptics::Hand there;
    there.position = truth.scene_from_device * Point<DeviceFrame>{sample.device_position.v};
    const Vec3 wanted_N = truth.touchable->evaluate(there, state).guide_N.v;
    // On a level surface without friction, what is along it is the pull.
    const Vec3 pull_N{sample.raw_force_N.v.x, sample.raw_force_N.v.y, 0.0};
    squares += squared_norm(pull_N - wanted_N);
    own_squares += squared_norm(wanted_N);
    compared += 1.0;
  }
  LedFromAfar led;
  const Vec3 at = (truth.scene_from_device * Point<DeviceFrame>{hand.place()}).v;
  led.from_the_end_m = std::hypot(at.x - kWayEnds.x, at.y - kWayEnds.y);
  led.made_J = bench.counts().made_max_J;
  led.max_growth_N = growth.most_N();
  led.difference_N = std::sqrt(squares / compared);
  led.pull_N = std::sqrt(own_squares / compared);
  return led;
}

TEST(RemotePull, LeadsAHandAroundACornerToTheEndAndMakesNoEnergy) {
  for (const LinkCase& link : kLinks) {
    const LedFromAfar led = led_from_afar(link.quality);
    EXPECT_LE(led.made_J, 2e-5) << link.name;
    EXPECT_LE(led.max_growth_N, 0.3 + 1e-6) << link.name;
    EXPECT_TRUE(led.from_the_end_m < 0.004 || link.quality.delay_s > 0.05)
        << link.name << ": " << led.from_the_end_m;
    if (prints_remote_touches())
      std::cout << "pull, " << link.name << ": " << 1e3 * led.from_the_end_m << " mm from the end, made "
                << 1e6 * led.made_J << " uJ, growth " << led.max_growth_N << " N, difference "
                << led.difference_N << " N of " << led.pull_N << " N\n";
  }
}

constexpr double kTaps_per_s = 4.0, kTapping_s = 5.0;

/// A hand that taps on level ground over a link.
struct TappedFromAfar {
  haptics::TickCounts counts;
  GreatestGrowth growth;
  std::vector<double> forces_N;
};

TappedFromAfar tapped_from_afar(const LinkQuality& quality, haptics::TransientKind transient) {
  device::HandOptions options;
  options.script.kind = device::HandScriptOptions::Kind::hold;
  auto own = std::make_unique<device::SimulatedHand>(options);
  device::SimulatedHand& hand = *own;
  TouchSettings settings;
  settings.transient = transient;
  const models::Scene scene = flat_scene(100, 80);
  const double ground_m =
      (haptics::fit_workspace(scene, hand.traits()).inverse() * Point<SceneFrame>{{0.0, 0.0, 0.001}}).v.z;
  hand.place({0.0, 0.0, ground_m + 0.01});
  RemoteBench bench(std::move(own), scene, settings, quality);
  TappedFromAfar tapped;
  while (bench.t_s() < kTapping_s) {
    hand.set_goal(
        {0.0, 0.0, ground_m + 0.012 * std::cos(2.0 * std::numbers::pi * kTaps_per_s * bench.t_s())});
    const haptics::TouchSample& sample = bench.step();
    tapped.growth.take(sample.written_force_N.v);
    tapped.forces_N.push_back(norm(sample.written_force_N));
  }
  tapped.counts = bench.counts();
  return tapped;
}

TEST(RemoteTransient, VibratesOnceForEachTapHoweverLateTheSurfaceIs) {
  constexpr double kTaps = kTaps_per_s * kTapping_s;
  for (const LinkCase& link : kLinks) {
    const TappedFromAfar wood = tapped_from_afar(link.quality, haptics::TransientKind::wood);
    EXPECT_LE(wood.counts.made_max_J, 2e-5) << link.name;
    EXPECT_LE(wood.growth.most_N(), 0.3 + 1e-6) << link.name;
    EXPECT_LE(static_cast<double>(wood.counts.transients), kTaps + 1.0) << link.name;
    EXPECT_TRUE(static_cast<double>(wood.counts.transients) >= kTaps - 2.0 || !link.is_usable)
        << link.name << ": " << wood.counts.transients;
    if (prints_remote_touches())
      std::cout << "wood, " << link.name << ": " << wood.counts.transients << " vibrations, made "
                << 1e6 * wood.counts.made_max_J << " uJ, growth " << wood.growth.most_N() << " N\n";
  }
}

TEST(RemoteTransient, IsFeltAtTheDevice) {
  const LinkQuality late{0.02, 0.0, 0.0};
  const TappedFromAfar wood = tapped_from_afar(late, haptics::TransientKind::wood);
  const TappedFromAfar plain = tapped_from_afar(late, haptics::TransientKind::none);
  EXPECT_EQ(plain.counts.transients, 0U);
  double most_N = 0.0;
  for (std::size_t n = 0; n < plain.forces_N.size(); ++n)
    most_N = std::max(most_N, std::abs(wood.forces_N[n] - plain.forces_N[n]));
  EXPECT_GT(most_N, 0.2);
}

}  // namespace
}  // namespace palpable::session
