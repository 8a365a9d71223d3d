// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/falcon/falcon_kinematics.hpp"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

Vec3 falcon_place(std::mt19937& random) {
  std::uniform_real_distribution<double> part(-0.5, 0.5);
  const Vec3 size = falcon::kWorkspace_m;
  const double x = size.x * part(random), y = size.y * part(random), z = size.z * part(random);
  return falcon::kCentre_m + Vec3{x, y, z};
}

/// A grid over the whole workspace with its borders and corners, and random places between.
std::vector<Vec3> falcon_places(int steps, int more) {
  std::vector<Vec3> places;
  const auto part = [&](int k) { return static_cast<double>(k) / steps - 0.5; };
  const Vec3 size = falcon::kWorkspace_m;
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k)
        places.push_back(falcon::kCentre_m + Vec3{size.x * part(i), size.y * part(j), size.z * part(k)});
  std::mt19937 random(19);
  for (int k = 0; k < more; ++k) places.push_back(falcon_place(random));
  return places;
}

TEST(FalconKinematics, FindsThePlaceOfTheAnglesOfAPlace) {
  double worst_m = 0.0;
  for (const Vec3 place : falcon_places(12, 2000)) {
    const auto angles = falcon::angles_at(place);
    ASSERT_TRUE(angles);
    const auto found = falcon::place_of(*angles);
    ASSERT_TRUE(found);
    worst_m = std::fmax(worst_m, norm(*found - place));
  }
  EXPECT_LT(worst_m, 1e-9);
}

TEST(FalconKinematics, MovesAsItsJacobianSays) {
  constexpr double kStep_rad = 1e-4;
  double worst = 0.0;
  for (const Vec3 place : falcon_places(6, 500)) {
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
