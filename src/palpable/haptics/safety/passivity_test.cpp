// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/safety/passivity.hpp"

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kT_s = 0.001;
constexpr double kStiffness = 1000.0;

/// A hand presses 5 mm into a held spring and leaves it smoothly within `seconds`. Returns the greatest
/// generated energy.
double press_once(PassivityObserver& observer, double damping, double seconds) {
  const int ticks = static_cast<int>(seconds / kT_s);
  double x = 0.0;
  Vector<DeviceFrame> held;
  for (int n = 1; n <= ticks; ++n) {
    const double before = x;
    const double angle = 2.0 * std::numbers::pi * n / ticks;
    x = -0.0025 * (1.0 - std::cos(angle));
    PassivityObserver::Step tick;
    tick.held_force_N = held;
    tick.moved_m = {{0.0, 0.0, x - before}};
    tick.dt_s = kT_s;
    tick.stored_J = 0.5 * kStiffness * x * x;
    tick.damping_Ns_per_m = damping;
    observer.update(tick);
    held = {{0.0, 0.0, -kStiffness * x - damping * (x - before) / kT_s}};
  }
  return observer.made_max_J();
}

TEST(PassivityObserver, DetectsTheEnergyThatAHeldSpringGenerates) {
  // A held spring generates ½K·dx² per tick, both on the way in and on the way out.
  PassivityObserver observer;
  const double made_J = press_once(observer, 0.0, 0.1);
  double expected_J = 0.0;
  double x = 0.0;
  for (int n = 1; n <= 100; ++n) {
    const double now = -0.0025 * (1.0 - std::cos(2.0 * std::numbers::pi * n / 100));
    expected_J += 0.5 * kStiffness * (now - x) * (now - x);
    x = now;
  }
  EXPECT_GT(expected_J, 1e-4);
  EXPECT_NEAR(made_J, expected_J, 1e-9);
}

TEST(PassivityObserver, DetectsNothingIfTheDamperDissipatesMoreThanTheSpringGenerates) {
  // At the start, the velocity estimate of the damper is smaller than the velocity that causes the delay of
  // the spring.
  PassivityObserver enough;
  EXPECT_LT(press_once(enough, 0.6, 0.1), 5e-7);
  PassivityObserver too_little;
  EXPECT_GT(press_once(too_little, 0.4, 0.1), 5e-6);
}

TEST(PassivityObserver, DoesNotCountOldDissipationAsReserve) {
  PassivityObserver observer;
  PassivityObserver::Step braking;
  braking.held_force_N = {{-1.0, 0.0, 0.0}};
  braking.moved_m = {{1e-4, 0.0, 0.0}};
  braking.dt_s = kT_s;
  for (int n = 0; n < 1000; ++n) observer.update(braking);
  PassivityObserver fresh;
  EXPECT_NEAR(press_once(observer, 0.0, 0.1), press_once(fresh, 0.0, 0.1), 1e-9);
}

TEST(PassivityObserver, DoesNotCountEnergyThatALimitWithheld) {
  PassivityObserver observer;
  PassivityObserver::Step tick;
  tick.held_force_N = {{0.0, 0.0, 1.0}};
  tick.moved_m = {{0.0, 0.0, -0.001}};
  tick.stored_J = 0.01;
  tick.dt_s = kT_s;
  tick.shortened = true;
  observer.update(tick);
  EXPECT_EQ(observer.made_max_J(), 0.0);
}

TEST(PassivityObserver, ReportsNoMoreThanTheHandReceived) {
  // A spring stores 1 mJ that nobody gave, and is lost in the next tick while its force gives 2 uJ.
  PassivityObserver observer;
  PassivityObserver::Step tick;
  tick.stored_J = 1e-3;
  observer.update(tick);
  tick.held_force_N = {{0.0, 0.0, 1.0}};
  tick.moved_m = {{0.0, 0.0, 2e-6}};
  observer.update(tick);
  EXPECT_GT(observer.made_J(), 9e-4) << "the controller's bound";
  EXPECT_NEAR(observer.made_max_J(), 2e-6, 1e-12);
}

TEST(PassivityObserver, DoesNotReportWhatTheSpringOfAForceOnItsWayHeld) {
  for (const std::size_t delay : {0U, 1U}) {
    PassivityObserver observer;
    PassivityObserver::Step tick;
    tick.delay = delay;
    // The hand gives 1 uJ and the spring is lost; its force acts a tick later, and gives that back.
    tick.held_force_N = {{0.0, 0.0, 1.0}};
    tick.moved_m = {{0.0, 0.0, -1e-6}};
    tick.stored_J = 1e-6;
    observer.update(tick);
    tick.moved_m = {};
    tick.stored_J = 0.0;
    observer.update(tick);
    tick.moved_m = {{0.0, 0.0, 1e-6}};
    observer.update(tick);
    EXPECT_NEAR(observer.made_max_J(), delay == 0 ? 1e-6 : 0.0, 1e-12);
  }
}

TEST(PassivityController, DissipatesExactlyTheGeneratedEnergyWherePossible) {
  const Vector<DeviceFrame> velocity{{0.1, 0.0, 0.0}};
  const auto braked = control_passivity({{1.0, 0.0, 0.0}}, velocity, 1e-6, kT_s);
  EXPECT_NEAR(dot(braked - Vector<DeviceFrame>{{1.0, 0.0, 0.0}}, velocity) * kT_s, -1e-6, 1e-15);
}

TEST(PassivityController, NeverPullsOrPushesSideways) {
  const Vector<DeviceFrame> force{{0.0, 0.3, 1.0}};
  for (const double made_J : {1e-8, 1e-6, 1e-3, 1.0})
    for (const Vec3 v :
         {Vec3{0.1, 0.0, 0.2}, Vec3{0.0, 0.0, 1e-6}, Vec3{0.0, 1.0, -1.0}, Vec3{3.0, 1.0, 0.0}}) {
      const auto weakened = control_passivity(force, {v}, made_J, kT_s);
      EXPECT_NEAR(norm(cross(weakened, force)), 0.0, 1e-12);
      EXPECT_GE(dot(weakened, force), 0.0);
      EXPECT_LE(norm(weakened), norm(force));
    }
}

TEST(PassivityObserver, CountsTheWorkOfAContactWithoutAPotential) {
  PassivityObserver observer;
  observer.begin(0.0, PassivityObserver::Beginning::from_no_force);
  PassivityObserver::Step step;
  step.stored_J = std::numeric_limits<double>::quiet_NaN();
  observer.update(step);
  step.contact = true;
  // In against a force of 1 N, out with a force of 2 N.
  step.held_force_N = {{0.0, 0.0, 1.0}};
  step.moved_m = {{0.0, 0.0, -1e-3}};
  observer.update(step);
  EXPECT_EQ(observer.made_max_J(), 0.0);
  step.held_force_N = {{0.0, 0.0, 2.0}};
  step.moved_m = {{0.0, 0.0, 1e-3}};
  observer.update(step);
  EXPECT_NEAR(observer.made_max_J(), 1e-3, 1e-15);
}

TEST(PassivityObserver, CountsTheEnergyOfATouchThatBeganInsideWithoutForce) {
  for (const double stored_J : {std::numeric_limits<double>::quiet_NaN(), 0.01}) {
    PassivityObserver observer;
    observer.begin(stored_J, PassivityObserver::Beginning::from_no_force);
    PassivityObserver::Step step;
    step.stored_J = stored_J;
    step.contact = true;
    step.shortened = true;
    for (int k = 1; k <= 10; ++k) {
      step.held_force_N = {{0.0, 0.0, 0.1 * k}};
      step.moved_m = {{0.0, 0.0, 1e-4}};
      observer.update(step);
    }
    EXPECT_NEAR(observer.made_max_J(), 5.5e-4, 1e-9);
  }
}

TEST(PassivityController, OnlyDissipatesEnergy) {
  EXPECT_EQ(control_passivity({{1.0, 2.0, 3.0}}, {{0.1, 0.0, 0.0}}, -1.0, kT_s).v, (Vec3{1.0, 2.0, 3.0}));
  EXPECT_EQ(control_passivity({{1.0, 2.0, 3.0}}, {}, 1.0, kT_s).v, (Vec3{1.0, 2.0, 3.0}));
}

}  // namespace
}  // namespace palpable::haptics
