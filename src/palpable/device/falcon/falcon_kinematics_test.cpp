// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_kinematics.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

Vec3 falcon_place(std::mt19937& random) {
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  const Vec3 size = falcon::kWorkspace_m;
  const double x = size.x * part(random), y = size.y * part(random), z = size.z * part(random);
  return falcon::kCentre_m + Vec3{x, y, z};
}

TEST(FalconKinematics, FindsThePlaceOfTheAnglesOfAPlace) {
  std::mt19937 random(19);
  double worst_m = 0.0;
  for (int k = 0; k < 2000; ++k) {
    const Vec3 place = falcon_place(random);
    const auto angles = falcon::angles_at(place);
    ASSERT_TRUE(angles);
    const auto found = falcon::place_of(*angles);
    ASSERT_TRUE(found);
    worst_m = std::fmax(worst_m, norm(*found - place));
  }
  EXPECT_LT(worst_m, 1e-9);
}

TEST(FalconKinematics, MovesAsItsJacobianSays) {
  std::mt19937 random(20);
  constexpr double kStep_rad = 1e-4;
  double worst = 0.0;
  for (int k = 0; k < 500; ++k) {
    const Vec3 place = falcon_place(random);
    const auto angles = falcon::angles_at(place);
    const auto moved = falcon::jacobian(*angles, place);
    ASSERT_TRUE(moved);
    for (std::size_t arm = 0; arm < 3; ++arm) {
      // Five points: the error is of the fourth order of the step.
      const auto at = [&](double steps) {
        ArmAngles turned = *angles;
        turned[arm] += steps * kStep_rad;
        return *falcon::place_of(turned, place);
      };
      const Vec3 measured = (8.0 * (at(1) - at(-1)) - (at(2) - at(-2))) / (12.0 * kStep_rad);
      worst = std::fmax(worst, norm(measured - (*moved)[arm]) / norm((*moved)[arm]));
    }
  }
  EXPECT_LT(worst, 1e-6);
}

TEST(FalconKinematics, IsSymmetricAboutItsAxis) {
  const auto angles = falcon::angles_at(falcon::kCentre_m);
  ASSERT_TRUE(angles);
  EXPECT_NEAR((*angles)[0], (*angles)[1], 1e-12);
  EXPECT_NEAR((*angles)[0], (*angles)[2], 1e-12);
  // Towards the user: every motor turns the same way.
  const auto torques = falcon::torques(*angles, falcon::kCentre_m, {0.0, 0.0, 1.0});
  EXPECT_NEAR((*torques)[0], (*torques)[2], 1e-12);
  EXPECT_GT((*torques)[0], 0.0);
}

TEST(FalconKinematics, GivesNothingWhereTheAnglesDetermineNoPlace) {
  EXPECT_FALSE(falcon::angles_at({0.3, 0.0, 0.1}));
  EXPECT_FALSE(falcon::place_of({3.0, -3.0, 3.0}));
  EXPECT_FALSE(falcon::place_of({NAN, 0.5, 0.5}));
  EXPECT_FALSE(falcon::jacobian({0.5, 0.5, 0.5}, {NAN, 0.0, 0.1}));
}

}  // namespace
}  // namespace palpable::device
