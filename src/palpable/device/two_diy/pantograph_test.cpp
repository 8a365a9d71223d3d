// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/device/two_diy/pantograph.hpp"

#include "palpable/device/two_diy/two_diy_variant.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::device {
namespace {

/// Places on a grid over the workspace of a variant.
std::vector<InPlane> places(const TwoDiyVariant& variant) {
  std::vector<InPlane> all;
  constexpr int kSteps = 20;
  for (int i = 0; i <= kSteps; ++i)
    for (int k = 0; k <= kSteps; ++k)
      all.push_back({variant.centre.x + variant.size.x * (static_cast<double>(i) / kSteps - 0.5),
                     variant.centre.y + variant.size.y * (static_cast<double>(k) / kSteps - 0.5)});
  return all;
}

TEST(Pantograph, FindsTheHandleAgainFromItsAngles) {
  for (const auto& variant : kTwoDiyVariants)
    for (const InPlane place : places(variant)) {
      const auto angles = variant.linkage.angles_at(place);
      ASSERT_TRUE(angles) << variant.name << " " << place.x << " " << place.y;
      const auto again = variant.linkage.handle_at(*angles);
      ASSERT_TRUE(again) << variant.name << " " << place.x << " " << place.y;
      EXPECT_LT(std::hypot(again->x - place.x, again->y - place.y), 1e-9);
    }
}

TEST(Pantograph, HasTheJacobianOfFiniteDifferences) {
  constexpr double kStep = 1e-5;
  for (const auto& variant : kTwoDiyVariants)
    for (const InPlane place : places(variant)) {
      const LinkAngles angles = *variant.linkage.angles_at(place);
      const auto moved = *variant.linkage.jacobian(angles);
      for (std::size_t motor = 0; motor < 2; ++motor) {
        LinkAngles less = angles;
        LinkAngles more = angles;
        less[motor] -= kStep;
        more[motor] += kStep;
        const InPlane from = *variant.linkage.handle_at(less);
        const InPlane to = *variant.linkage.handle_at(more);
        const double scale = std::hypot(moved[motor].x, moved[motor].y);
        EXPECT_NEAR(moved[motor].x, (to.x - from.x) / (2.0 * kStep), 1e-6 * scale) << variant.name;
        EXPECT_NEAR(moved[motor].y, (to.y - from.y) / (2.0 * kStep), 1e-6 * scale) << variant.name;
      }
    }
}

TEST(Pantograph, OfTheFirstVersionIsFoldedAtItsHomePosition) {
  const Pantograph linkage{0.07, 0.09, 0.0};
  constexpr double kDegree = std::numbers::pi / 180.0;
  const auto home = linkage.handle_at({241.0 * kDegree, -61.0 * kDegree});
  ASSERT_TRUE(home);
  EXPECT_NEAR(home->x, 0.0, 1e-12);
  // By hand: the elbows lie 61.2 mm behind the motors, 67.9 mm apart.
  EXPECT_NEAR(home->y, 0.0221, 1e-4);
}

TEST(Pantograph, HasNoPlaceWhereItsLinksDoNotMeetOrItsElbowsCoincide) {
  constexpr double kPi = std::numbers::pi;
  const Pantograph one_axis{0.07, 0.09, 0.0};
  EXPECT_FALSE(one_axis.handle_at({1.0, 1.0}));
  const Pantograph wide{0.07, 0.06, 0.038};
  EXPECT_FALSE(wide.handle_at({kPi, 0.0}));
  EXPECT_FALSE(wide.torques({kPi, 0.0}, {1.0, 0.0}));
  EXPECT_FALSE(wide.handle_at({std::nan(""), 0.0}));
  EXPECT_FALSE(wide.angles_at({0.0, 1.0}));
}

}  // namespace
}  // namespace palpable::device
