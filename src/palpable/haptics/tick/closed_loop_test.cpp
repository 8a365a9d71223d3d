// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
// Tests the tick together with the simulated hand, on surfaces with known solutions.
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/test_period.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

struct ClosedLoop {
  ClosedLoop(SpringSurface::Shape shape, double stiffness, double damping, const device::HandOptions& options,
             const TickOptions& limits = {})
      : hand(options) {
    program.touchable = std::make_shared<SpringSurface>(shape, stiffness, damping);
    tick = std::make_unique<TickPipeline>(hand, program, limits, events);
  }
  const TouchSample& run(int ticks) {
    for (int i = 0; i < ticks; ++i) sample = &tick->step(kT_s * static_cast<double>(n++), kT_s);
    return *sample;
  }
  /// The greatest distance along z or x between two positions of the hand in the next `ticks`.
  double swing(int ticks, double Vec3::*axis) {
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (int i = 0; i < ticks; ++i) {
      run(1);
      least = std::min(least, hand.true_position_m().*axis);
      most = std::max(most, hand.true_position_m().*axis);
    }
    return most - least;
  }

  device::SimulatedHand hand;
  HapticScene program;
  Ring<TouchEvent> events{1024};
  std::unique_ptr<TickPipeline> tick;
  const TouchSample* sample = nullptr;
  std::int64_t n = 0;
};

device::HandOptions held() {
  device::HandOptions options;
  options.script.kind = device::HandScriptOptions::Kind::hold;
  options.device_friction_N = 0.0;
  options.resolution_m = 0.0;
  return options;
}

TEST(ClosedLoop, ComesToRestWhereTheArmAndTheWallAgree) {
  // The arm pulls with 135 N/m towards 10 mm below the surface, the wall has 500 N/m: the hand rests at a
  // depth of 10·135/635 mm.
  ClosedLoop loop(flat, 500.0, 0.5, held());
  loop.hand.place({0.0, 0.0, 0.002});
  loop.hand.set_goal({0.0, 0.0, -0.010});
  const auto& sample = loop.run(4000);
  EXPECT_NEAR(loop.hand.true_position_m().z, -0.010 * 135.0 / 635.0, 1e-7);
  EXPECT_NEAR(sample.written_force_N.v.z, 500.0 * 0.010 * 135.0 / 635.0, 1e-4);
  EXPECT_LT(norm(loop.hand.true_velocity_m_per_s()), 1e-7);
}

TEST(ClosedLoop, FeelsNothingAboveTheSurface) {
  ClosedLoop loop(bump, 500.0, 0.5, held());
  loop.hand.place({0.0, 0.0, 0.0101});
  loop.run(1000);
  EXPECT_EQ(loop.tick->counts().contact_ticks, 0U);
  EXPECT_EQ(loop.tick->counts().max_force_N, 0.0);
}

TEST(ClosedLoop, IsPushedAsideOnASphereAlongItsNormal) {
  ClosedLoop loop(bump, 500.0, 0.5, held());
  loop.hand.place({0.005, 0.0, 0.012});
  loop.hand.set_goal({0.005, 0.0, 0.004});
  loop.run(300);
  const auto& sample = loop.run(1);
  const Vec3 p = sample.position.v;
  const Vec3 outwards = unit(Vec3{p.x, p.y, p.z + 0.03});
  EXPECT_GT(dot(unit(sample.raw_force_N.v), outwards), 0.9995);
  EXPECT_GT(sample.raw_force_N.v.x, 0.0);
}

TEST(ClosedLoop, GeneratesNoEnergyOnAPlaneBelowTheStabilityLimit) {
  for (const int delay : {0, 1, 2}) {
    auto options = held();
    options.delay_samples = delay;
    // b > (2d + 1)·K·T/2, with a margin of 20 %.
    const double damping = 0.5;
    const double stiffness = 2.0 * damping / ((2.0 * delay + 1.0) * kT_s) / 1.2;
    TickOptions limits;
    limits.passivity = Passivity::observe;
    ClosedLoop loop(flat, stiffness, damping, options, limits);
    loop.hand.place({0.0, 0.0, 0.003});
    loop.hand.set_goal({0.0, 0.0, -0.010});
    loop.run(4000);
    EXPECT_GT(loop.tick->counts().contact_ticks, 3000U);
    EXPECT_LT(loop.swing(1000, &Vec3::z), 10e-6) << "delay " << delay;
  }
}

/// How far a hand swings on a wall that is 13 times too stiff for a delay of two ticks.
double swing_on_a_too_stiff_wall_m(Passivity passivity, Returns returns) {
  auto options = held();
  options.device_mass_kg = 0.1;
  options.arm_mass_kg = 0.0;
  options.arm_damping_Ns_per_m = 1.0;
  options.delay_samples = 2;
  options.max_force_N = 20.0;
  TickOptions limits;
  limits.passivity = passivity;
  limits.returns = returns;
  limits.max_force_rate_N_per_s = 1e6;
  ClosedLoop loop(flat, 3000.0, 0.0, options, limits);
  loop.hand.place({0.0, 0.0, 0.001});
  loop.hand.set_goal({0.0, 0.0, -0.010});
  loop.run(3000);
  return loop.swing(1000, &Vec3::z);
}

TEST(ClosedLoop, ControllerAndReturnLimitEachEndTheOscillationOfATooStiffWall) {
  EXPECT_GT(swing_on_a_too_stiff_wall_m(Passivity::observe, Returns::free), 20e-3);
  EXPECT_LT(swing_on_a_too_stiff_wall_m(Passivity::control, Returns::free), 0.3e-3);
  EXPECT_LT(swing_on_a_too_stiff_wall_m(Passivity::observe, Returns::limited), 0.3e-3);
  EXPECT_LT(swing_on_a_too_stiff_wall_m(Passivity::control, Returns::limited), 0.3e-3);
}

TEST(ClosedLoop, SameSeedGivesTheSameTouchToTheLastBit) {
  const auto run = [](std::uint64_t seed) {
    device::HandOptions options;
    options.script.seed = seed;
    options.script.kind = device::HandScriptOptions::Kind::random;
    ClosedLoop loop(bump, 500.0, 0.5, options);
    loop.run(3000);
    return loop.hand.true_position_m();
  };
  EXPECT_EQ(run(5), run(5));
  EXPECT_NE(run(5), run(6));
}

TEST(ClosedLoop, TheScriptedHandFindsTheSurfaceStrokesItAndLiftsOff) {
  for (const auto kind : {device::HandScriptOptions::Kind::scan, device::HandScriptOptions::Kind::random}) {
    device::HandOptions options;
    options.script.kind = kind;
    ClosedLoop loop(bump, 500.0, 0.5, options);
    int lifts = 0;
    bool contact = false;
    Vec3 least{1.0, 1.0, 1.0};
    Vec3 most{-1.0, -1.0, -1.0};
    double force_N = 0.0;
    for (int i = 0; i < 60000; ++i) {
      const auto& sample = loop.run(1);
      const bool now = sample.has(flag::kContact);
      lifts += contact && !now ? 1 : 0;
      contact = now;
      if (!now) continue;
      const Vec3 p = sample.position.v;
      least = {std::min(least.x, p.x), std::min(least.y, p.y), 0.0};
      most = {std::max(most.x, p.x), std::max(most.y, p.y), 0.0};
      force_N += sample.written_force_N.v.z;
    }
    const auto touched = static_cast<double>(loop.tick->counts().contact_ticks);
    EXPECT_GT(touched, 0.6 * 60000);
    EXPECT_GE(lifts, 5);
    EXPECT_GT(most.x - least.x, 0.08);
    EXPECT_GT(most.y - least.y, 0.08);
    EXPECT_NEAR(force_N / touched, 0.8, 0.25);
    EXPECT_LT(loop.tick->counts().max_force_N, 3.3 + 1e-9);
  }
}

}  // namespace
}  // namespace palpable::haptics
