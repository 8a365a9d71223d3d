// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/device.hpp"

#include <limits>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinite = std::numeric_limits<double>::infinity();

TEST(Traits, ThatAreUnknownWhereTheyMayBeArePassed) {
  Traits traits;
  EXPECT_TRUE(check(traits));
  traits.mass_kg = traits.damping_Ns_per_m = traits.position_resolution_m = kNotANumber;
  traits.degrees_of_freedom = 2;
  EXPECT_TRUE(check(traits));
}

TEST(Traits, ThatWouldLeaveAForceWithoutALimitAreRefused) {
  for (const double force : {kNotANumber, kInfinite, 0.0, -1.0}) {
    Traits traits;
    traits.max_force_N = force;
    EXPECT_FALSE(check(traits)) << force;
  }
  for (const double torque : {kNotANumber, kInfinite, 0.0, -1.0}) {
    Traits traits;
    traits.max_torque_Nm = torque;
    EXPECT_EQ(check(traits).has_value(), torque == 0.0) << torque;
    traits.has_torque = true;
    EXPECT_FALSE(check(traits)) << torque;
  }
}

TEST(Traits, ThatNoHandCanMoveInAreRefused) {
  for (const Vec3 size :
       {Vec3{0.0, 0.1, 0.1}, Vec3{0.1, kNotANumber, 0.1}, Vec3{0.1, 0.1, -0.1}, Vec3{kInfinite, 1, 1}}) {
    Traits traits;
    traits.workspace_m = size;
    EXPECT_FALSE(check(traits)) << size.x << ' ' << size.y << ' ' << size.z;
  }
  for (const int degrees : {-1, 0, 1, 4, 6}) {
    Traits traits;
    traits.degrees_of_freedom = degrees;
    EXPECT_FALSE(check(traits)) << degrees;
  }
  Traits late;
  late.delay_samples = -1;
  EXPECT_FALSE(check(late));
}

TEST(Traits, ThatNoDeviceHasAreRefused) {
  const auto with = [](double Traits::*property, double value) {
    Traits traits;
    traits.*property = value;
    return check(traits).has_value();
  };
  EXPECT_TRUE(with(&Traits::max_force_N, 40.0));
  EXPECT_FALSE(with(&Traits::max_force_N, 1e6));
  for (const double mass_kg : {-1.0, 0.0, 1e6, kInfinite}) EXPECT_FALSE(with(&Traits::mass_kg, mass_kg));
  EXPECT_TRUE(with(&Traits::mass_kg, 0.05));
  for (const auto property :
       {&Traits::damping_Ns_per_m, &Traits::coulomb_friction_N, &Traits::position_resolution_m,
        &Traits::inertia_kg_m2, &Traits::rotational_damping_Nm_s}) {
    EXPECT_TRUE(with(property, 0.0));
    EXPECT_FALSE(with(property, -1.0));
    EXPECT_FALSE(with(property, 1e6));
  }
  EXPECT_FALSE(with(&Traits::rate_hz, 0.0));
  EXPECT_FALSE(with(&Traits::rate_hz, 1e9));
}

}  // namespace
}  // namespace palpable::device
