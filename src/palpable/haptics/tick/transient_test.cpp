// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/allocations.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"
#include "palpable/haptics/tick/transient_player.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr TransientPlayer::Limits kWide{100.0, 1e9, 0.02};

TEST(TransientPlayer, IsADecayingSinusoidOfTheMaterialAndTheImpact) {
  constexpr ContactTransient kBell{2.0, 50.0, 30.0};
  TransientPlayer player;
  const Vector<DeviceFrame> push{{0.0, 0.0, 10.0}};
  player.strike(kBell, push, {{0.05, 0.0, -0.3}}, kWide);
  for (int n = 0; n < 40; ++n) {
    const double t_s = (n + 0.5) * kT_s;
    EXPECT_NEAR(player.step(push, push, kT_s).v.z,
                0.6 * std::exp(-30.0 * t_s) * std::sin(2 * M_PI * 50.0 * t_s), 1e-12)
        << n;
  }
  for (int n = 0; n < 200; ++n) player.step(push, push, kT_s);
  EXPECT_FALSE(player.is_playing());
  EXPECT_EQ(player.step(push, push, kT_s).v, Vec3{});
}

TEST(TransientPlayer, KeepsToItsLimitsAndNeverPulls) {
  constexpr ContactTransient kHard{50.0, 100.0, 10.0};
  TransientPlayer player;
  const Vector<DeviceFrame> push{{0.0, 0.0, 0.1}};
  player.strike(kHard, push, {{0.0, 0.0, -1.0}}, {0.5, 1e9, 0.02});
  double least_N = 1.0;
  double most_N = 0.0;
  for (int n = 0; n < 50; ++n) {
    const double force_N = player.step(push, push, kT_s).v.z;
    least_N = std::min(least_N, force_N);
    most_N = std::max(most_N, force_N);
  }
  EXPECT_NEAR(most_N, 0.5, 0.05);
  EXPECT_EQ(least_N, -0.1) << "it takes the push away, and no more";
  player.strike(kHard, push, {{0.0, 0.0, -1.0}}, {0.5, 100.0, 0.02});
  EXPECT_LE(player.step(push, push, kT_s).v.z, 100.0 * kT_s);
}

TEST(TransientPlayer, NeverPullsOnASurfaceThatHasTurnedSinceItWasStruck) {
  constexpr ContactTransient kRubber{2.0, 18.0, 60.0};
  for (const double turned_rad : {0.5, 1.2, 1.6, 2.5, 3.1}) {
    TransientPlayer player;
    player.strike(kRubber, {{0.0, 0.0, 1.0}}, {{0.0, 0.0, -1.0}}, kWide);
    // The hand crosses a ridge, with hardly any force from its other side.
    const Vector<DeviceFrame> spring{{0.1 * std::sin(turned_rad), 0.0, 0.1 * std::cos(turned_rad)}};
    double added_N = 0.0;
    for (int n = 0; n < 60; ++n) {
      const Vector<DeviceFrame> added = player.step(spring, spring, kT_s);
      EXPECT_GE(dot(spring + added, spring), -1e-15) << turned_rad << ", " << n;
      added_N = std::max(added_N, norm(added));
    }
    EXPECT_GT(added_N, 0.05) << turned_rad;
  }
}

TEST(TransientPlayer, IsSilentForASlowOrALeavingHandAndForAMaterialWithoutOne) {
  const Vector<DeviceFrame> push{{0.0, 0.0, 1.0}};
  TransientPlayer player;
  player.strike({2.0, 50.0, 30.0}, push, {{0.0, 0.0, -0.01}}, kWide);
  EXPECT_FALSE(player.is_playing());
  player.strike({2.0, 50.0, 30.0}, push, {{0.0, 0.0, 0.3}}, kWide);
  EXPECT_FALSE(player.is_playing());
  player.strike({}, push, {{0.0, 0.0, -0.3}}, kWide);
  EXPECT_FALSE(player.is_playing());
}

TEST(TransientPlayer, IsOffForDevicesThatCannot) {
  const auto wood = transient_of(TransientKind::wood);
  const auto metal = transient_of(TransientKind::metal);
  device::Traits device;
  EXPECT_TRUE(can_render(wood, device, 1000.0));
  EXPECT_FALSE(can_render(metal, device, 1000.0)) << "fewer than five ticks to a period";
  EXPECT_FALSE(can_render(metal, device, 4000.0)) << "the device is slower than the loop";
  device.rate_hz = 4000.0;
  EXPECT_TRUE(can_render(metal, device, 4000.0));
  device.pushes_back = false;
  EXPECT_FALSE(can_render(transient_of(TransientKind::rubber), device, 1000.0));
}

/// A hand that taps on level ground four times per second, for 5 s.
struct Taps {
  explicit Taps(const ContactTransient& transient, Passivity passivity = Passivity::control) {
    device::HandOptions options;
    options.script.kind = device::HandScriptOptions::Kind::hold;
    options.max_force_N = 10.0;
    device::SimulatedHand hand(options);
    hand.place({0.0, 0.0, 0.01});
    const HapticScene scene{std::make_shared<SpringSurface>(flat, 500.0, 0.5), {}, 1, transient};
    TickOptions limits;
    limits.passivity = passivity;
    Ring<TouchEvent> events(64);
    TickPipeline tick(hand, scene, limits, events);
    double before_N = 0.0;
    for (int n = 0; n < 5000; ++n) {
      hand.set_goal({0.0, 0.0, 0.012 * std::cos(2 * M_PI * 4.0 * n * kT_s)});
      const AllocationScope scope;
      const TouchSample& sample = tick.step(n * kT_s, kT_s);
      allocations += scope.count();
      while (events.take()) {
      }
      const double force_N = sample.written_force_N.v.z;
      greatest_step_N = std::max(greatest_step_N, force_N - before_N);
      least_N = std::min(least_N, force_N);
      if (!sample.has(flag::kContact)) in_air_N = std::max(in_air_N, std::abs(force_N));
      before_N = force_N;
      forces_N.push_back(force_N);
    }
    counts = tick.counts();
  }
  std::vector<double> forces_N;
  TickCounts counts;
  double greatest_step_N = 0.0;
  double least_N = 0.0;
  double in_air_N = 0.0;
  std::size_t allocations = 0;
};

TEST(ContactTransients, VibrateOnceForEachTapWithinAllLimits) {
  const Taps taps(transient_of(TransientKind::wood));
  EXPECT_NEAR(static_cast<double>(taps.counts.transients), 20.0, 1.0);
  EXPECT_LE(taps.greatest_step_N,
            TickOptions{}.max_force_rate_N_per_s * TickOptions{}.max_rise_time_s + 1e-9);
  EXPECT_GE(taps.least_N, 0.0) << "never a pull";
  EXPECT_EQ(taps.in_air_N, 0.0);
  EXPECT_EQ(taps.allocations, 0U);
  const Taps plain(ContactTransient{});
  EXPECT_EQ(plain.counts.transients, 0U);
  double greatest_N = 0.0;
  for (std::size_t n = 0; n < plain.forces_N.size(); ++n)
    greatest_N = std::max(greatest_N, std::abs(taps.forces_N[n] - plain.forces_N[n]));
  EXPECT_GT(greatest_N, 0.2) << "it is there";
}

TEST(ContactTransients, CountTheirEnergyWhichTheControllerDissipates) {
  // Soft ground with a long transient: energy returned by a spring cannot hide it.
  const ContactTransient ringing{20.0, 20.0, 2.0};
  const Taps observed(ringing, Passivity::observe);
  EXPECT_GT(observed.counts.made_max_J, 1e-6) << "the observer sees it";
  const Taps controlled(ringing);
  EXPECT_GT(controlled.counts.passivity_ticks, 0U);
  EXPECT_LT(controlled.counts.made_max_J, observed.counts.made_max_J);
}

TEST(ContactTransients, AreTheSameToTheLastBitEachTime) {
  const ContactTransient wood = transient_of(TransientKind::wood);
  EXPECT_EQ(Taps(wood).forces_N, Taps(wood).forces_N);
}

}  // namespace
}  // namespace palpable::haptics
