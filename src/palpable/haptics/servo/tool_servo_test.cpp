// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/system/allocations.hpp"
#include "palpable/device/simulated/simulated_hand.hpp"
#include "palpable/haptics/law/law_making.hpp"
#include "palpable/haptics/law/tool.hpp"
#include "palpable/haptics/tick/rotation.hpp"
#include "palpable/haptics/tick/tick.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::haptics {

/// The solid below z = 0. It is not in an unnamed namespace, so that its read_pages() is found.
class FloorOfTools {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept { return {p.v.z, {{0.0, 0.0, 1.0}}}; }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return 0; }
};
inline void read_pages(const FloorOfTools&) noexcept {}

namespace {

using FloorTool = ToolLaw<FloorOfTools>;

HapticScene with_tool(double stiffness_N_per_m, double damping_Ns_per_m, const ToolShape& shape) {
  FloorTool law(std::make_shared<const FloorOfTools>(),
                MaterialMap(Contact{stiffness_N_per_m, damping_Ns_per_m, 0.0, 0.0}), shape);
  HapticScene scene;
  scene.touchable = std::make_shared<LawTouchable<FloorTool>>(std::move(law), 1);
  scene.id = 1;
  return scene;
}

device::HandOptions hand_with_torque() {
  device::HandOptions hand;
  hand.has_torque = true;
  hand.script.workspace_m = {0.1, 0.1, 0.05};
  return hand;
}

TEST(TurnBetween, IsTheRotationVectorThatWasApplied) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int k = 0; k < 1000; ++k) {
    const Vec3 axis = unit({any(random), any(random), any(random)});
    const double angle = 3.0 * std::abs(any(random));
    const double c = std::cos(angle), s = std::sin(angle), t = 1.0 - c;
    const device::Rotation rotation{
        c + axis.x * axis.x * t,          axis.x * axis.y * t - axis.z * s, axis.x * axis.z * t + axis.y * s,
        axis.y * axis.x * t + axis.z * s, c + axis.y * axis.y * t,          axis.y * axis.z * t - axis.x * s,
        axis.z * axis.x * t - axis.y * s, axis.z * axis.y * t + axis.x * s, c + axis.z * axis.z * t};
    ASSERT_TRUE(is_rotation(rotation));
    EXPECT_LT(norm(rotation_between(device::kIdentityRotation, rotation).v - angle * axis), 1e-6);
  }
  EXPECT_FALSE(is_rotation({1, 0, 0, 0, 1, 0, 0, 0, -1}));
  EXPECT_FALSE(is_rotation({std::nan(""), 0, 0, 0, 1, 0, 0, 0, 1}));
}

TEST(ToolInTheServo, IsFeltWithForceAndTorqueWithinTheDevicesLimitsAndMakesNoEnergy) {
  ASSERT_TRUE(allocations_are_counted());
  // Random hands with a pad or a cane, whose stiffness is the greatest that a sample point at its end allows.
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0.0, 1.0);
  for (int round = 0; round < 40; ++round) {
    device::HandOptions options = hand_with_torque();
    options.script.seed = static_cast<std::uint64_t>(round);
    options.tilt_hz = 0.2 + 2.0 * any(random);
    options.max_torque_Nm = 0.02 + 0.2 * any(random);
    options.hand_rotational_stiffness_Nm = 0.5 + any(random);
    const bool cane = round % 2 == 0;
    const ToolShape shape = cane ? ToolShape{0.004, 0.02, 32} : ToolShape{};
    device::SimulatedHand hand(options);
    Ring<TouchEvent> events(1024);
    TickOptions tick;
    tick.passivity = Passivity::observe;
    const HapticScene scene = with_tool(150.0 + 150.0 * any(random), 0.4, shape);
    TickPipeline pipeline(hand, scene, tick, events);
    Vec3 before_Nm;
    double torque_Nm = 0.0;
    const AllocationScope scope;
    for (int k = 0; k < 4000; ++k) {
      const TouchSample& sample = pipeline.step(0.001 * k, 0.001);
      const Vec3 now_Nm = sample.written_torque_Nm.v;
      ASSERT_LE(norm(now_Nm), options.max_torque_Nm + 1e-12);
      ASSERT_LE(norm(now_Nm) - norm(before_Nm), 30.0 * 0.001 + 1e-12);
      if (!sample.has(flag::kContact)) {
        ASSERT_EQ(now_Nm, Vec3{});
      }
      torque_Nm = std::max(torque_Nm, norm(now_Nm));
      before_Nm = now_Nm;
      while (events.take()) {
      }
    }
    EXPECT_EQ(scope.count(), 0U);
    EXPECT_GT(pipeline.counts().contact_ticks, 500U) << round;
    // A round pad on a level floor is hardly rotated.
    EXPECT_GT(torque_Nm, cane ? 1e-4 : 1e-5) << round;
    EXPECT_LT(pipeline.counts().made_max_J, 5e-6) << round;
  }
}

TEST(ToolInTheServo, CountsTheWorkOfATorque) {
  // A torque without potential that gives energy to the hand in a rotation: the observer measures it, the
  // controller dissipates it.
  PassivityObserver observer;
  PassivityObserver::Step air;
  air.stored_J = std::nan("");
  observer.update(air);
  PassivityObserver::Step step = air;
  step.contact = true;
  step.rotation_J = 2e-4;
  step.held_force_N = {{0.0, 0.0, 1e-9}};
  observer.update(step);
  EXPECT_NEAR(observer.made_J(), 2e-4, 1e-12);
  EXPECT_NEAR(passivity_factor(0.4, observer.made_J(), 0.001), 0.5, 1e-9);
}

TEST(ToolInTheServo, RefusesAHandleThatTurnsFasterThanAHandCan) {
  struct Turning final : device::Device {
    Turning() {
      its.has_torque = true;
      its.max_torque_Nm = 1.0;
    }
    const device::Traits& traits() const noexcept override { return its; }
    device::Reading read() noexcept override { return reading; }
    void write(Vector<DeviceFrame>) noexcept override {}
    void stop() noexcept override {}
    device::Traits its;
    device::Reading reading;
  } device;
  device.reading.position.v = {0.0, 0.0, 0.007};
  Ring<TouchEvent> events(64);
  const HapticScene scene = with_tool(300.0, 0.4, {});
  TickPipeline pipeline(device, scene, {}, events);
  for (int k = 0; k < 500; ++k) pipeline.step(0.001 * k, 0.001);
  const double s = std::sin(0.5), c = std::cos(0.5);
  device.reading.rotation = {c, -s, 0, s, c, 0, 0, 0, 1};
  EXPECT_TRUE(pipeline.step(0.5, 0.001).has(flag::kImplausible));
  device.reading.rotation = {2, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_TRUE(pipeline.step(0.501, 0.001).has(flag::kImplausible));
}

}  // namespace
}  // namespace palpable::haptics
