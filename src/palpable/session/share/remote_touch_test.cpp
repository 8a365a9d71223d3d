// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/session/share/measured_remote_touch.hpp"
#include "palpable/session/touch/test_session.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(RemoteTouch, IsPassiveAndNeverStepsWhateverTheLinkIsLike) {
  const models::Scene scene = hilly_scene(kHills_m);
  const haptics::TickOptions limits;
  for (const LinkCase& link : kLinks) {
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      const RemotelyTouched touched = remote_touch(scene, link.quality, seed);
      // The rise limit of one tick, and not more than the device can give.
      EXPECT_LE(touched.max_growth_N, 1e-6 + limits.max_force_rate_N_per_s * RemoteBench::kTick_s)
          << link.name;
      EXPECT_LE(touched.max_force_N, 3.3 + 1e-6) << link.name;
      EXPECT_TRUE(touched.contact_ticks > 500.0 || !link.is_usable) << link.name;
      // A late change of the surface may spend what the hand lost to damper and friction in half a second,
      // which the observer does not count; without a delay nothing is made.
      EXPECT_LE(touched.counts.made_max_J, 2e-5) << link.name << ", seed " << seed;
      EXPECT_TRUE(touched.counts.made_max_J <= 1e-6 || link.quality.delay_s > 0.0) << seed;
      if (prints_remote_touches())
        std::cout << link.name << ", seed " << seed << ": contact " << touched.contact_ticks
                  << " ticks, growth " << touched.max_growth_N << " N, most " << touched.max_force_N
                  << " N, made " << 1e6 * touched.counts.made_max_J << " uJ (without controller "
                  << 1e6 * touched.counts.made_max_without_controller_J << "), difference "
                  << touched.rms_difference_N << " N of " << touched.rms_force_N << " N, faults "
                  << touched.counts.fault_ticks << "\n";
    }
  }
}

TEST(RemoteTouch, HasTheForcesOfTheSceneWithoutADelay) {
  const RemotelyTouched touched = remote_touch(hilly_scene(kHills_m), {}, 4);
  EXPECT_GT(touched.rms_force_N, 0.1);
  EXPECT_LT(touched.rms_difference_N, 0.05 * touched.rms_force_N);
}

/// The hills with ridges 2 mm apart, rougher than usual.
models::Scene ridged_scene() {
  models::Scene scene = hilly_scene(kHills_m);
  models::Material material;
  material.static_friction = 0.5;
  material.dynamic_friction = 0.4;
  material.texture.kind = models::TouchTexture::Kind::ridges;
  material.texture.pitch_m = 0.002;
  material.texture.height_m = 40e-6;
  scene.materials = {material};
  return scene;
}

TEST(RemoteTouch, RendersFrictionAndTexturesAtTheDevice) {
  const models::Scene ridged = ridged_scene();
  const RemotelyTouched without_delay = remote_touch(ridged, {}, 4);
  EXPECT_LT(without_delay.rms_difference_N, 0.05 * without_delay.rms_force_N);
  const LinkQuality late{0.005, 0.002, 0.01};
  const RemotelyTouched textured = remote_touch(ridged, late, 4);
  EXPECT_LT(textured.rms_difference_N, 0.06 * textured.rms_force_N);
  const RemotelyTouched untextured = remote_touch(ridged, {}, 4, SentTextures::none);
  EXPECT_GT(untextured.rms_difference_N, 2.0 * without_delay.rms_difference_N);
  EXPECT_LE(textured.counts.made_max_J, 2e-5);
  if (!prints_remote_touches()) return;
  std::cout << "ridges that are not sent: difference " << untextured.rms_difference_N << " N\n";
  models::Scene smooth = ridged;
  smooth.materials.front().texture = {};
  for (const models::Scene* scene : {&ridged, static_cast<const models::Scene*>(&smooth)})
    for (const LinkCase& link : kLinks) {
      const RemotelyTouched touched = remote_touch(*scene, link.quality, 4);
      std::cout << (scene == &ridged ? "ridges, " : "smooth, ") << link.name << ": difference "
                << touched.rms_difference_N << " N of " << touched.rms_force_N << " N, made "
                << 1e6 * touched.counts.made_max_J << " uJ\n";
    }
}

/// Presses a hand onto a flat relief over a link of 5 ms and returns the bench.
class RemoteFault : public testing::Test {
 protected:
  RemoteFault() {
    device::HandOptions options;
    options.script.kind = device::HandScriptOptions::Kind::hold;
    auto hand = std::make_unique<device::SimulatedHand>(options);
    hand_ = hand.get();
    const models::Scene scene = hilly_scene(0.0001);
    hand_->set_goal({0.0, 0.0, 0.02});
    TouchSettings settings;
    bench_ = std::make_unique<RemoteBench>(std::move(hand), scene, settings, LinkQuality{0.005, 0.0, 0.0});
    step(500);
    hand_->set_goal({0.0, 0.0, -0.03});
    step(1500);
  }
  double step(int ticks) {
    double force_N = 0.0;
    for (int k = 0; k < ticks; ++k) force_N = norm(bench_->step().written_force_N);
    return force_N;
  }
  /// Ticks until there is no force.
  int ticks_to_zero(int most) {
    for (int k = 1; k <= most; ++k)
      if (step(1) == 0.0) return k;
    return most + 1;
  }
  device::SimulatedHand* hand_ = nullptr;
  std::unique_ptr<RemoteBench> bench_;
};

TEST_F(RemoteFault, ALostLinkHasNoForceTenMillisecondsAfterItsSurfaceIsTooOld) {
  ASSERT_GT(step(1), 0.2);
  bench_->cut_link(true);
  const int silent = static_cast<int>(std::lround(1e3 * device::SharedDevice::kSilent_s));
  // Until then the surface is rendered here as before.
  EXPECT_GT(step(silent - 10), 0.2);
  EXPECT_LE(ticks_to_zero(40), 10 + 10);
  // And it stays so.
  for (int k = 0; k < 200; ++k) EXPECT_EQ(step(1), 0.0);
}

TEST_F(RemoteFault, AtAnyInstantALostConnectionMeansNoForceWithinTenMillisecondsAndARampAfterwards) {
  // As many as PALPABLE_FAULTS says.
  const char* wanted = std::getenv("PALPABLE_FAULTS");
  const int times = wanted != nullptr ? std::atoi(wanted) : 20;
  std::mt19937 random(23);
  const int too_old = static_cast<int>(std::lround(1e3 * device::SharedDevice::kSilent_s));
  int slowest_lost = 0, slowest_silent = 0;
  for (int time = 0; time < 2 * times; ++time) {
    SCOPED_TRACE(time);
    // Out of the wall, into which the hand sank, and against it again.
    hand_->set_goal({0.0, 0.0, 0.02});
    step(600);
    hand_->set_goal({0.0, 0.0, -0.03});
    step(700 + static_cast<int>(random() % 500));
    ASSERT_GT(step(1), 0.1);
    // The connection ends, which the host knows at once; or nothing comes any more.
    const bool is_silent = time % 2 == 1;
    if (is_silent)
      bench_->cut_link(true);
    else
      bench_->set_connected(false);
    int& slowest = is_silent ? slowest_silent : slowest_lost;
    slowest = std::max(slowest, ticks_to_zero(300));
    for (int k = 0; k < 50; ++k) ASSERT_EQ(step(1), 0.0);
    bench_->cut_link(false);
    bench_->set_connected(true);
    double before_N = 0.0;
    constexpr double kMostRise_N = 0.3;
    for (int k = 0; k < 100; ++k) {
      const double force_N = step(1);
      ASSERT_LE(force_N, 3.3 + 1e-6);
      ASSERT_LE(force_N - before_N, kMostRise_N + 1e-6) << k;
      before_N = force_N;
    }
  }
  EXPECT_LE(slowest_lost, 10);
  EXPECT_LE(slowest_silent, too_old + 20);
  std::cout << times << " lost connections: no force after " << slowest_lost << " ms; " << times
            << " silent ones: after " << slowest_silent << " ms\n";
}

TEST_F(RemoteFault, ALinkThatComesBackRampsTheForceUp) {
  const double pressed_N = step(1);
  bench_->cut_link(true);
  step(300);
  bench_->cut_link(false);
  // The hand has sunk in meanwhile. It is not pushed out with energy that it did not give.
  double before_N = 0.0, most_rise_N = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double force_N = step(1);
    most_rise_N = std::max(most_rise_N, force_N - before_N);
    before_N = force_N;
  }
  EXPECT_GT(before_N, 0.0);
  EXPECT_LT(most_rise_N, 0.05);
  // And it feels the whole surface again after it has left it once.
  hand_->set_goal({0.0, 0.0, 0.02});
  step(1000);
  hand_->set_goal({0.0, 0.0, -0.03});
  step(1500);
  EXPECT_NEAR(step(1), pressed_N, 0.1 * pressed_N);
}

}  // namespace
}  // namespace palpable::session
