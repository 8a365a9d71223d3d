// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/servo/moved_workspace.hpp"

#include "palpable/core/system/allocations.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/servo/test_touch.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kRate_Hz = 1000.0;
constexpr double kT_s = 1.0 / kRate_Hz;
/// The rise limit, N per tick.
const double kRise_N = TickOptions{}.max_force_rate_N_per_s * kT_s;

/// A scripted device with a workspace of 100 x 100 x 50 mm in a MovedWorkspace.
struct Scripted {
  explicit Scripted(const WorkspaceOptions& options, std::shared_ptr<WorkspaceState> state = nullptr) {
    auto owned = std::make_unique<ScriptedDevice>();
    device = owned.get();
    moved = std::make_unique<MovedWorkspace>(std::move(owned), options, kRate_Hz, std::move(state));
  }
  Vec3 at(Vec3 position_m, std::uint32_t buttons = 0, Vec3 force_N = {}) {
    device->reading.position.v = position_m;
    device->reading.buttons = buttons;
    const auto reading = moved->read();
    clutched = reading.clutched;
    moved->note_ramp(ramp);
    moved->write({force_N});
    return reading.position.v;
  }
  ScriptedDevice* device = nullptr;
  std::unique_ptr<MovedWorkspace> moved;
  bool clutched = false;
  double ramp = 1.0;
};

WorkspaceOptions magnified(double times) {
  WorkspaceOptions options;
  options.magnification = times;
  options.clutch_button = 0;
  return options;
}

TEST(MovedWorkspace, ChangesNothingInsideOfAWorkspaceThatIsNotMoved) {
  Scripted test{WorkspaceOptions{}};
  for (int tick = 0; tick < 1000; ++tick) {
    const Vec3 place{0.05 * std::sin(0.01 * tick), 0.05 * std::cos(0.013 * tick),
                     0.025 * std::sin(0.02 * tick)};
    EXPECT_EQ(test.at(place, tick % 2, {0.0, 0.0, 1.0}), place);
    EXPECT_EQ(test.device->written.back(), (Vec3{0.0, 0.0, 1.0}));
    EXPECT_FALSE(test.clutched);
  }
}

TEST(MovedWorkspace, HoldsThePlaceWhileItIsClutchedAndGoesOnFromThere) {
  const auto state = std::make_shared<WorkspaceState>();
  Scripted test(magnified(2.0), state);
  Vec3 before = test.at({0.01, 0.0, 0.0});
  EXPECT_EQ(state->offset_m[0], 0.0);
  for (int tick = 1; tick <= 300; ++tick) {
    const bool pressed = tick > 100 && tick <= 200;
    const Vec3 now = test.at({0.01 + 1e-4 * tick, 2e-5 * tick, 0.0}, pressed ? 1 : 0);
    EXPECT_EQ(test.clutched, pressed);
    EXPECT_NEAR(norm(now - before), pressed ? 0.0 : std::hypot(1e-4, 2e-5), 1e-12) << tick;
    before = now;
  }
  EXPECT_NEAR(test.moved->offset_m().x, -0.01, 1e-12);
  EXPECT_EQ(state->offset_m[0], test.moved->offset_m().x);
  EXPECT_EQ(state->offset_m[1], test.moved->offset_m().y);
  Scripted opened_again(magnified(2.0), state);
  EXPECT_EQ(state->offset_m[0], 0.0) << "the device's positions are its own again";
}

TEST(MovedWorkspace, WantsNoForceFromAPressOfTheStopButtonToTheNext) {
  WorkspaceOptions options;
  options.stop_button = 1;
  const auto state = std::make_shared<WorkspaceState>();
  Scripted test(options, state);
  for (int tick = 0; tick < 400; ++tick) {
    const bool pressed = tick % 200 >= 50 && tick % 200 < 100;
    // Other buttons do nothing, and a place is never moved.
    const Vec3 place{1e-4 * tick, 0.0, 0.0};
    EXPECT_EQ(test.at(place, pressed ? 2 : 1), place);
    EXPECT_EQ(test.clutched, tick >= 50 && tick < 250) << tick;
    EXPECT_EQ(state->stopped.load(), test.clutched);
  }
  // A device that is opened again begins as the one before ended.
  state->stopped = true;
  Scripted again(options, state);
  again.at({});
  EXPECT_TRUE(again.clutched);
  options.clutch_button = 1;
  EXPECT_FALSE(check(options));
}

TEST(MovedWorkspace, MovesTheSceneNoFartherThanItReaches) {
  WorkspaceOptions options = magnified(10.0);
  options.cushion = false;
  const auto state = std::make_shared<WorkspaceState>();
  // A scene that is wide and flat, seen from the middle of a workspace of 100 x 100 x 50 mm.
  state->scene_m[0] = 0.4;
  state->scene_m[1] = 0.4;
  state->scene_m[2] = 0.02;
  Scripted test(options, state);
  for (int tick = 0; tick < 20'000; ++tick) test.at({0.05, 0.0, 0.025});
  // Its end, the outer tenth and an eighth of the width as air: 400 - 50 + 10 + 12.5, and 20 - 25 + 5 + 6.25.
  EXPECT_NEAR(test.moved->offset_m().x, 0.3725, 1e-5);
  EXPECT_NEAR(test.moved->offset_m().z, 0.00625, 1e-5);
  // A smaller scene does not make the place jump, and lets it back.
  state->scene_m[0] = 0.1;
  const double before_m = test.moved->offset_m().x;
  test.at({0.05, 0.0, 0.0});
  EXPECT_NEAR(test.moved->offset_m().x, before_m, 1e-4);
  for (int tick = 0; tick < 3000; ++tick) test.at({-0.05, 0.0, 0.0});
  EXPECT_LT(test.moved->offset_m().x, before_m - 0.05);
}

TEST(MovedWorkspace, MovesTheSceneBeneathAHandAtTheBorderContinuouslyToItsEnd) {
  const WorkspaceOptions options = magnified(3.0);
  Scripted test(options);
  Vec3 before = test.at({0.048, 0.0, 0.0});
  double speed = 0.0;
  double fastest = 0.0;
  for (int tick = 0; tick < 20000; ++tick) {
    const Vec3 now = test.at({0.048, 0.0, 0.0});
    const double next = (now.x - before.x) / kT_s;
    EXPECT_GE(next, -1e-9);
    EXPECT_LE(std::abs(next - speed), options.drive_speed_m_per_s * 0.011);
    fastest = std::max(fastest, next);
    speed = next;
    before = now;
  }
  EXPECT_NEAR(fastest, 0.8 * options.drive_speed_m_per_s, 1e-3);
  // The scene ends two halves of the workspace farther; slower and slower towards it.
  EXPECT_GT(before.x, 0.048 + 0.145);
  EXPECT_LE(before.x, 0.048 + 0.150);
  EXPECT_LT(speed, 0.1 * fastest);
  // In the middle nothing moves.
  for (int tick = 0; tick < 1000; ++tick) test.at({0.048 - 4.8e-5 * tick, 0.0, 0.0});
  const Vec3 rests = test.moved->offset_m();
  for (int tick = 0; tick < 1000; ++tick) test.at({0.0, 0.0, 0.0});
  EXPECT_NEAR(norm(test.moved->offset_m() - rests), 0.0, 1e-5);
}

TEST(MovedWorkspace, StandsStillWhileTheTouchIsPaused) {
  Scripted test(magnified(3.0));
  test.ramp = 0.0;
  for (int tick = 0; tick < 2000; ++tick) test.at({0.05, 0.05, 0.0});
  EXPECT_EQ(test.moved->offset_m(), Vec3{});
  for (const Vec3& force : test.device->written) EXPECT_EQ(force, Vec3{});
}

/// A hand on an arm, which wants to be far outside, or to swing through the border; runs it without a touch.
struct Border {
  double most_N = 0.0;
  double most_rise_N = 0.0;
  double farthest_m = 0.0;
  double given_J = 0.0;
  double made_J = 0.0;
};
Border run_hand(const device::HandOptions& hand_options, const WorkspaceOptions& options, double seconds,
                const std::function<Vec3(double t_s)>& goal,
                const std::function<Vec3(Vec3 scene_place)>& law = {}) {
  auto owned = std::make_unique<device::SimulatedHand>(hand_options);
  device::SimulatedHand& hand = *owned;
  hand.place({});
  MovedWorkspace moved(std::move(owned), options, kRate_Hz);
  Border border;
  Vec3 before_N;
  Vec3 at = hand.true_position_m();
  for (int tick = 0; tick < static_cast<int>(seconds * kRate_Hz); ++tick) {
    hand.set_goal(goal(kT_s * tick));
    const auto reading = moved.read();
    moved.note_ramp(1.0);
    const Vec3 touch_N = law ? law(reading.position.v) : Vec3{};
    moved.write({touch_N});
    const Vec3 force_N = touch_N + moved.cushion_N().v;
    border.given_J += dot(force_N, hand.true_position_m() - at);
    at = hand.true_position_m();
    border.most_N = std::max(border.most_N, norm(force_N));
    if (norm(force_N) > norm(before_N))
      border.most_rise_N = std::max(border.most_rise_N, norm(force_N - before_N));
    border.farthest_m = std::max(border.farthest_m, std::abs(at.x));
    before_N = force_N;
  }
  border.made_J = moved.cushion_made_max_J();
  return border;
}

TEST(MovedWorkspace, TheCushionHoldsTheHandSoftlyAndMakesNoEnergy) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  int reached = 0;
  for (int hand = 0; hand < 60; ++hand) {
    device::HandOptions options;
    options.script.kind = device::HandScriptOptions::Kind::hold;
    options.device_mass_kg = 0.05 + 0.15 * part(random);
    options.arm_mass_kg = 0.3 * part(random);
    options.arm_stiffness_N_per_m = 50.0 + 950.0 * part(random);
    options.arm_damping_Ns_per_m = 2.0 + 18.0 * part(random);
    options.delay_samples = hand % 3;
    const double out_m = 0.05 + 0.03 * part(random);
    const double hz = 0.3 + 3.0 * part(random);
    const auto goal = [&](double t_s) { return Vec3{out_m * std::sin(6.2832 * hz * t_s), 0.0, 0.0}; };
    WorkspaceOptions off;
    off.cushion = false;
    const Border free = run_hand(options, off, 4.0, goal);
    const Border border = run_hand(options, {}, 4.0, goal);
    EXPECT_EQ(free.most_N, 0.0);
    if (free.farthest_m > 0.055) {
      ++reached;
      EXPECT_GT(border.most_N, 0.0) << hand;
      EXPECT_LT(border.farthest_m, free.farthest_m) << hand;
    }
    EXPECT_LE(border.most_N, 2.0 * 0.3 * options.max_force_N + 1e-9);
    EXPECT_LE(border.most_rise_N, kRise_N + 1e-9);
    EXPECT_LE(border.made_J, 1e-6) << hand;
    // It takes energy on the whole; what it still stores in the end is the hand's own.
    EXPECT_LE(border.given_J, 1e-6) << hand;
  }
  EXPECT_GT(reached, 30);
}

TEST(MovedWorkspace, AHandThatBeginsBeyondTheBorderFeelsNoCushionBeforeItHasMovedInward) {
  Scripted test{WorkspaceOptions{}};
  for (int tick = 0; tick < 100; ++tick) test.at({0.058, 0.0, 0.0});
  EXPECT_EQ(test.device->written.back(), Vec3{});
  for (int tick = 0; tick < 100; ++tick) test.at({0.058 - 4e-5 * tick, 0.0, 0.0});
  EXPECT_EQ(test.device->written.back(), Vec3{});
  for (int tick = 0; tick < 100; ++tick) test.at({0.054 + 4e-5 * tick, 0.0, 0.0});
  EXPECT_LT(test.device->written.back().x, -0.05);
  // Readings that are none, and jumps, end it at once.
  test.at({std::numeric_limits<double>::quiet_NaN(), 0.0, 0.0});
  EXPECT_EQ(test.device->written.back(), Vec3{});
  test.at({0.058, 0.0, 0.0});
  test.at({-0.058, 0.0, 0.0});
  EXPECT_EQ(test.device->written.back(), Vec3{});
}

TEST(MovedWorkspace, AMovingSceneGivesAHandNoMoreThanItsReserve) {
  // A wall of the scene comes towards a hand that presses outward, and pushes it back.
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> part(0.0, 1.0);
  double most_J = -1.0;
  for (int hand = 0; hand < 40; ++hand) {
    device::HandOptions options;
    options.script.kind = device::HandScriptOptions::Kind::hold;
    options.arm_stiffness_N_per_m = 50.0 + 200.0 * part(random);
    const double wall_m = 0.06 + 0.03 * part(random);
    const double stiffness = 200.0 + 300.0 * part(random);
    const double pull_m = 0.01 + 0.05 * part(random);
    const auto goal = [&](double t_s) {
      return Vec3{0.05 + pull_m * std::sin(1.3 * t_s), 0.01 * std::sin(2.0 * t_s), 0.0};
    };
    const auto law = [&](Vec3 place) {
      return Vec3{-std::min(options.max_force_N, stiffness * std::max(0.0, place.x - wall_m)), 0.0, 0.0};
    };
    constexpr double kSeconds = 20.0;
    const Border border = run_hand(options, magnified(4.0), kSeconds, goal, law);
    most_J = std::max(most_J, border.given_J);
    EXPECT_GT(border.most_N, 0.0);
    // Far less than the account allows: the scene stops before it presses the wall into the hand.
    EXPECT_LE(border.given_J, 1e-3);
  }
  RecordProperty("given_most_J", std::to_string(most_J));
}

TEST(MovedWorkspace, AClutchRampsTheTouchsForceDownAndUpAgain) {
  auto owned = std::make_unique<ScriptedDevice>();
  ScriptedDevice& device = *owned;
  MovedWorkspace moved(std::move(owned), magnified(2.0), kRate_Hz);
  const SpringSurface surface(flat, 300.0, 0.5);
  const HapticScene scene{std::shared_ptr<const Touchable>(&surface, [](const Touchable*) {}), {}, 1};
  Ring<TouchEvent> events{256};
  TickPipeline tick(moved, scene, {}, events);
  const auto run = [&](int ticks, std::uint32_t buttons, Vec3 speed_m_per_s) {
    for (int k = 0; k < ticks; ++k) {
      device.reading.buttons = buttons;
      device.reading.position.v += kT_s * speed_m_per_s;
      tick.step(0.0, kT_s);
    }
    return norm(device.written.back());
  };
  device.reading.position.v = {0.0, 0.0, 0.002};
  run(100, 0, {});
  EXPECT_GT(run(100, 0, {0.0, 0.0, -0.04}), 0.4);
  const double pressed_N = run(300, 0, {});
  EXPECT_NEAR(pressed_N, 0.6, 0.01);
  // While it is clutched: no force, also where the hand moves far into the solid.
  EXPECT_EQ(run(100, 1, {0.05, 0.0, -0.05}), 0.0);
  run(1, 0, {});
  EXPECT_LE(norm(device.written.back()), kRise_N);
  EXPECT_NEAR(run(600, 0, {}), pressed_N, 0.05);
  double rise = 0.0;
  for (std::size_t k = 1; k < device.written.size(); ++k)
    rise = std::max(rise, norm(device.written[k]) - norm(device.written[k - 1]));
  EXPECT_LE(rise, kRise_N + 1e-9);
}

TEST(MovedWorkspace, NeverAllocatesAndNeverExceedsTheDevicesForce) {
  ASSERT_TRUE(allocations_are_counted());
  Scripted test(magnified(2.0));
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const AllocationScope scope;
  for (int tick = 0; tick < 20000; ++tick) {
    test.ramp = std::abs(part(random));
    test.at({0.08 * std::sin(0.003 * tick), 0.2 * part(random) * (tick % 50 == 0), 0.03 * part(random)},
            tick / 300 % 2, {3.0 * part(random), 0.0, 0.0});
    EXPECT_LE(norm(test.device->written.back()), 3.0 + 1e-12);
  }
  EXPECT_EQ(scope.count(), 0U);
}

TEST(MovedWorkspace, ChecksItsOptions) {
  EXPECT_TRUE(check(magnified(10.0)));
  for (const double times : {0.5, 11.0, std::nan("")}) EXPECT_FALSE(check(magnified(times))) << times;
  WorkspaceOptions options;
  options.clutch_button = 32;
  EXPECT_FALSE(check(options));
}

}  // namespace
}  // namespace palpable::haptics
