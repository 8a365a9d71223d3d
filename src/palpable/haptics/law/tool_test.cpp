// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/law/tool.hpp"

#include "palpable/core/system/allocations.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kWall_N_per_m = 800.0;

class SolidFloor {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept { return {p.v.z, {{0.0, 0.0, 1.0}}}; }
  double cell_m() const noexcept { return 2e-4; }
  std::size_t memory_bytes() const noexcept { return 0; }
};

ToolLaw<SolidFloor> cane_on_floor(double damping_Ns_per_m) {
  return {std::make_shared<const SolidFloor>(),
          MaterialMap(Contact{kWall_N_per_m, damping_Ns_per_m, 0.0, 0.0}), ToolShape{0.004, 0.1, 32}};
}

/// A hand that holds a tool tilted about y.
Hand tilted(double angle_rad, Vec3 at_m) {
  Hand hand;
  hand.position.v = at_m;
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  hand.rotation = {c, 0, s, 0, 1, 0, -s, 0, c};
  return hand;
}

TEST(ToolLaw, PushesAndTurnsAHandThatPressesATiltedCane) {
  const auto law = cane_on_floor(0.0);
  ToolLaw<SolidFloor>::State state;
  // Its end is at 0.1 m along -z of the tool: at x = -0.1 sin.
  const LawOutput felt = law.evaluate(tilted(0.2, {0.0, 0.0, 0.1 * std::cos(0.2) + 0.002}), state);
  ASSERT_TRUE(felt.contact);
  EXPECT_GT(felt.force_N.v.z, 0.05);
  EXPECT_NEAR(felt.force_N.v.x, 0.0, 1e-12);
  // r x f with r = (-0.1 sin, 0, -0.1 cos) and f = (0, 0, f): about +y.
  EXPECT_NEAR(felt.torque_Nm.v.y, 0.1 * std::sin(0.2) * felt.force_N.v.z, 0.005 * felt.force_N.v.z);
  EXPECT_EQ(felt.spring_N.v, felt.force_N.v);
}

TEST(ToolLaw, ForceAndTorqueAreTheDerivativesOfWhatItStores) {
  const auto law = cane_on_floor(0.0);
  ToolLaw<SolidFloor>::State state;
  const Vec3 at{0.0, 0.0, 0.1 * std::cos(0.2) + 0.001};
  const auto stored = [&](double angle, double dz) {
    return law.evaluate(tilted(angle, at + Vec3{0.0, 0.0, dz}), state).stored_J;
  };
  const LawOutput felt = law.evaluate(tilted(0.2, at), state);
  constexpr double kStep = 1e-7;
  EXPECT_NEAR(felt.force_N.v.z, -(stored(0.2, kStep) - stored(0.2, -kStep)) / (2.0 * kStep), 1e-5);
  EXPECT_NEAR(felt.torque_Nm.v.y, -(stored(0.2 + kStep, 0.0) - stored(0.2 - kStep, 0.0)) / (2.0 * kStep),
              1e-5);
}

TEST(ToolLaw, DampsAPlaceByItsOwnVelocityAndNeverPulls) {
  const auto law = cane_on_floor(5.0);
  ToolLaw<SolidFloor>::State state;
  Hand hand = tilted(0.2, {0.0, 0.0, 0.1 * std::cos(0.2) + 0.002});
  const double resting_N = law.evaluate(hand, state).force_N.v.z;
  // Turned so that the end goes down: omega x r has z = -omega_y r_x > 0 for omega_y > 0, as r_x < 0.
  hand.angular_velocity_rad_per_s = {{0.0, -2.0, 0.0}};
  EXPECT_GT(law.evaluate(hand, state).force_N.v.z, resting_N);
  hand.angular_velocity_rad_per_s = {{0.0, 1000.0, 0.0}};
  EXPECT_EQ(law.evaluate(hand, state).force_N.v, Vec3{});
}

TEST(ToolLaw, NeitherPushesNorAllocatesInFreeAir) {
  ASSERT_TRUE(allocations_are_counted());
  const auto law = cane_on_floor(1.0);
  ToolLaw<SolidFloor>::State state;
  const AllocationScope scope;
  for (int k = 0; k < 1000; ++k) {
    const double angle = 0.001 * k - 0.5;
    const LawOutput clear = law.evaluate(tilted(angle, {0.0, 0.0, 0.1 * std::cos(angle) + 0.0041}), state);
    ASSERT_FALSE(clear.contact);
    ASSERT_EQ(clear.force_N.v, Vec3{});
    ASSERT_EQ(clear.torque_Nm.v, Vec3{});
    ASSERT_EQ(clear.stored_J, 0.0);
  }
  EXPECT_EQ(scope.count(), 0U);
}

}  // namespace
}  // namespace palpable::haptics
