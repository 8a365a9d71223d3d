// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/haptics/effect/tool_touch.hpp"

#include "palpable/core/system/allocations.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::haptics {
namespace {

constexpr double kStiffness_N_per_m = 800.0;

class Ball {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept { return {norm(p.v) - 0.02, {unit(p.v)}}; }
  double cell_m() const noexcept { return 2e-4; }
};

/// The solid below z = 0.
class Floor {
 public:
  models::FieldSample sample(Point<SceneFrame> p) const noexcept { return {p.v.z, {{0.0, 0.0, 1.0}}}; }
  double cell_m() const noexcept { return 2e-4; }
};

using Pose = Transform<SceneFrame, ToolFrame>;

/// Rotation about an axis (Rodrigues).
Pose turned(Vec3 axis, double angle_rad, Vec3 at_m) {
  const Vec3 n = unit(axis);
  const double c = std::cos(angle_rad), s = std::sin(angle_rad), t = 1.0 - c;
  Pose pose;
  pose.rotation = {c + n.x * n.x * t,       n.x * n.y * t - n.z * s, n.x * n.z * t + n.y * s,
                   n.y * n.x * t + n.z * s, c + n.y * n.y * t,       n.y * n.z * t - n.x * s,
                   n.z * n.x * t - n.y * s, n.z * n.y * t + n.x * s, c + n.z * n.z * t};
  pose.translation_m = at_m;
  return pose;
}

const std::vector<ToolPlace> kPad = cap_places(0.008, 1.0, 24);
/// A stick of 0.1 m, held at its middle.
const std::array<ToolPlace, 2> kStick{{{{{-0.05, 0.0, 0.0}}, 0.5}, {{{0.05, 0.0, 0.0}}, 0.5}}};

TEST(ToolTouch, IsThePointForceForAToolOfOnePlace) {
  const std::array<ToolPlace, 1> point{};
  Pose pose;
  pose.translation_m = {0.0, 0.0, 0.018};
  const Wrench w = tool_wrench(Ball{}, point, pose, kStiffness_N_per_m);
  EXPECT_TRUE(w.contact);
  EXPECT_NEAR(w.force_N.v.z, 1.6, 1e-12);
  EXPECT_EQ(norm(w.torque_Nm), 0.0);
}

TEST(ToolTouch, AppliesATorqueToAStickPushedAtOneEnd) {
  // Tilted about y so that the end at +x is under the floor.
  const Wrench w =
      tool_wrench(Floor{}, kStick, turned({0.0, 1.0, 0.0}, 0.1, {0.0, 0.0, 0.003}), kStiffness_N_per_m);
  const double depth = 0.05 * std::sin(0.1) - 0.003;
  EXPECT_NEAR(w.force_N.v.z, 0.5 * kStiffness_N_per_m * depth, 1e-12);
  // r x f = (0.05 cos, 0, .) x (0, 0, f): lifts that end.
  EXPECT_NEAR(w.torque_Nm.v.y, -0.05 * std::cos(0.1) * w.force_N.v.z, 1e-12);
  EXPECT_NEAR(w.torque_Nm.v.x, 0.0, 1e-15);
}

TEST(ToolTouch, ForceAndTorqueAreTheDerivativesOfOneEnergy) {
  const auto energy = [](const Pose& pose) {
    return tool_wrench(Ball{}, kPad, pose, kStiffness_N_per_m).stored_J;
  };
  const Vec3 at{0.004, -0.003, 0.0265}, axis{0.3, 1.0, -0.2};
  constexpr double kAngle = 0.4, kStep = 1e-6;
  const Wrench w = tool_wrench(Ball{}, kPad, turned(axis, kAngle, at), kStiffness_N_per_m);
  ASSERT_TRUE(w.contact);
  const double along_x = (energy(turned(axis, kAngle, at + Vec3{kStep, 0.0, 0.0})) -
                          energy(turned(axis, kAngle, at - Vec3{kStep, 0.0, 0.0}))) /
                         (2.0 * kStep);
  EXPECT_NEAR(w.force_N.v.x, -along_x, 1e-6);
  const double round_axis =
      (energy(turned(axis, kAngle + kStep, at)) - energy(turned(axis, kAngle - kStep, at))) / (2.0 * kStep);
  EXPECT_NEAR(dot(w.torque_Nm.v, unit(axis)), -round_axis, 1e-8);
}

TEST(ToolTouch, GeneratesNoEnergyOnAClosedPathOfPoses) {
  double work_J = 0.0, swing_J = 0.0;
  constexpr int kSteps = 20000;
  const auto pose = [](int i) {
    const double t = 2.0 * std::numbers::pi * i / kSteps;
    return turned({1.0, 0.5, 0.2}, 0.3 * std::sin(t),
                  {0.004 * std::cos(t), 0.003 * std::sin(2.0 * t), 0.0265});
  };
  for (int i = 0; i < kSteps; ++i) {
    const Pose before = pose(i), after = pose(i + 1);
    const Wrench a = tool_wrench(Ball{}, kPad, before, kStiffness_N_per_m);
    const Wrench b = tool_wrench(Ball{}, kPad, after, kStiffness_N_per_m);
    const double t = 2.0 * std::numbers::pi * (i + 0.5) / kSteps;
    const double turn = 0.3 * std::cos(t) * 2.0 * std::numbers::pi / kSteps;
    work_J += 0.5 * dot(a.force_N.v + b.force_N.v, after.translation_m - before.translation_m);
    work_J += 0.5 * turn * dot(a.torque_Nm.v + b.torque_Nm.v, unit({1.0, 0.5, 0.2}));
    swing_J = std::max(swing_J, a.stored_J);
  }
  EXPECT_GT(swing_J, 1e-6);
  EXPECT_LT(std::abs(work_J), 1e-5 * swing_J);
}

TEST(ToolTouch, ServesFiveFingersOnOneSurfaceWithoutAllocating) {
  ASSERT_TRUE(allocations_are_counted());
  const AllocationScope scope;
  Vec3 sum;
  int touching = 0;
  for (int finger = 0; finger < 5; ++finger) {
    Pose pose;
    pose.translation_m = {0.02 * (finger - 2), 0.0, 0.0065 + 0.0005 * finger};
    const Wrench w = tool_wrench(Floor{}, kPad, pose, kStiffness_N_per_m);
    touching += w.contact ? 1 : 0;
    sum += w.force_N.v;
  }
  EXPECT_EQ(scope.count(), 0U);
  EXPECT_EQ(touching, 3);
  EXPECT_GT(sum.z, 0.0);
}

TEST(ToolTouch, SpreadsAPadEvenlyOverItsCap) {
  double share = 0.0;
  Vec3 mean;
  for (const ToolPlace& p : kPad) {
    EXPECT_NEAR(norm(p.place.v), 0.008, 1e-12);
    EXPECT_LE(std::acos(-p.place.v.z / 0.008), 1.0);
    share += p.share;
    mean += p.share * p.place.v;
  }
  EXPECT_NEAR(share, 1.0, 1e-12);
  // The centroid of the area of a spherical cap: half of the height of both.
  EXPECT_NEAR(mean.z, -0.004 * (1.0 + std::cos(1.0)), 1e-5);
  EXPECT_NEAR(std::hypot(mean.x, mean.y), 0.0, 3e-4);
}

}  // namespace
}  // namespace palpable::haptics
