// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Surfaces that a change of scene brings up under a hand, as a live source sends them.
#include "palpable/haptics/tick/counted_hand.hpp"
#include "palpable/haptics/tick/test_loop.hpp"

#include <algorithm>
#include <memory>
#include <ostream>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

/// Below the stiffness limit of a device whose forces act so many ticks late.
constexpr double kStiffness_N_per_m[]{400.0, 250.0, 150.0};
constexpr double kJump_m = 0.012;

/// A plane that lies kJump_m higher.
std::shared_ptr<const Touchable> high_plane(double stiffness_N_per_m, std::uint64_t family) {
  const auto high = [](double, double) { return SpringSurface::Height{kJump_m, 0.0, 0.0}; };
  return std::make_shared<SpringSurface>(high, stiffness_N_per_m, 0.6, family);
}

/// Where a hand of an arm of 150 N/m wants to be, how late its forces act, and whether the higher plane
/// counts as the same surface.
struct Lift {
  double goal_m;
  int delay;
  bool is_same_surface;
};
void PrintTo(const Lift& lift, std::ostream* out) {
  *out << "goal " << lift.goal_m << " m, delay " << lift.delay
       << (lift.is_same_surface ? ", same surface" : "");
}

class Lifted : public testing::TestWithParam<Lift> {};

TEST_P(Lifted, HandIsNotThrownAndWhatItGetsIsSaid) {
  const double stiffness_N_per_m = kStiffness_N_per_m[GetParam().delay];
  device::HandOptions options;
  options.arm_mass_kg = 0.2;
  options.arm_damping_Ns_per_m = 3.0;
  options.arm_stiffness_N_per_m = 150.0;
  options.max_force_N = 10.0;
  options.delay_samples = GetParam().delay;
  options.script.kind = device::HandScriptOptions::Kind::hold;
  CountedHand hand(options);
  HapticScene low;
  low.touchable = std::make_shared<SpringSurface>(flat, stiffness_N_per_m, 0.6);
  const HapticScene high{high_plane(stiffness_N_per_m, GetParam().is_same_surface ? 1 : 2), {}, 2};
  TickOptions tick_options;
  tick_options.fade_s = 0.03;
  Ring<TouchEvent> events(64);
  TickPipeline tick(hand, low, tick_options, events);
  hand.set_goal({0.0, 0.0, 0.01});
  double growth_N = 0.0, fastest_m_per_s = 0.0, least_J = 0.0, got_J = 0.0;
  int lifting = 0;
  Vec3 before_N;
  for (int n = 0; n < 2200; ++n) {
    if (n == 100) hand.set_goal({0.0, 0.0, GetParam().goal_m});
    if (n == 1200) tick.change(high);
    const double before_m = hand.true_position_m().z;
    const TouchSample& sample = tick.step(kT_s * n, kT_s);
    const Vec3 written_N = sample.written_force_N.v;
    if (n == 1200) least_J = hand.total_J();
    if (n >= 1200) {
      growth_N = std::max(growth_N, norm(written_N) - norm(before_N));
      fastest_m_per_s = std::max(fastest_m_per_s, (hand.true_position_m().z - before_m) / kT_s);
      got_J = std::max(got_J, hand.total_J() - least_J);
      lifting += sample.has(flag::kLifting) ? 1 : 0;
    }
    before_N = written_N;
  }
  const TickCounts& counts = tick.counts();
  const TickOptions defaults;
  // Of the spring, and as much of a hand that moves in meanwhile. Before: 0.16 N in a tick, 0.2 m/s, 20 mJ.
  EXPECT_LE(growth_N, 2.5 * stiffness_N_per_m * defaults.max_lift_m_per_s * kT_s);
  EXPECT_LE(fastest_m_per_s, 1.6 * defaults.max_lift_m_per_s);
  EXPECT_GT(got_J, 1e-3) << "it is lifted";
  EXPECT_GE(counts.scene_change_J, got_J);
  EXPECT_LE(counts.made_max_without_controller_J, 1e-6);
  EXPECT_EQ(counts.passivity_ticks, 0U);
  // The surface rises for as long as it needs at that speed, and then the hand meets all of it.
  EXPECT_NEAR(lifting, 1000.0 * (kJump_m + std::min(0.0, -GetParam().goal_m)) / defaults.max_lift_m_per_s,
              60);
  EXPECT_NEAR(before_N.z, stiffness_N_per_m * (kJump_m - hand.true_position_m().z), 0.05);
}

INSTANTIATE_TEST_SUITE_P(Hands, Lifted,
                         testing::Values(Lift{-0.005, 0, false}, Lift{-0.005, 1, true},
                                         Lift{-0.005, 2, false}, Lift{0.004, 1, false}));

TEST(Lift, OfASurfaceThatFallsAgainTakesNothingBeyondIt) {
  Loop loop(plane(500.0));
  loop.device.reading.position.v.z = 0.0005;
  loop.run(10);
  for (int k = 1; k <= 200; ++k) {
    loop.device.reading.position.v.z = 0.0005 - 1.25e-5 * k;
    loop.run(1);
  }
  const HapticScene high{high_plane(500.0, 2), {}, 2};
  const HapticScene low{plane(500.0, 3), {}, 3};
  loop.tick->change(high);
  loop.run(155);
  EXPECT_TRUE(loop.sample->has(flag::kLifting));
  EXPECT_LT(loop.written().z, 3.0) << "the law wants 5.6 N, and the device can give 3";
  loop.tick->change(low);
  loop.run(155);
  EXPECT_FALSE(loop.sample->has(flag::kLifting));
  EXPECT_NEAR(loop.written().z, 500.0 * 0.002, 1e-9);
}

}  // namespace
}  // namespace palpable::haptics
