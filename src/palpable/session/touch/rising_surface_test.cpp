// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/rising_surface.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

constexpr double kPixel_m = 0.0005, kFrame_s = 1.0 / 30.0;
constexpr Point<SceneFrame> kHand{{0.003, -0.002, 0.0049}};

std::shared_ptr<const models::Relief> plane(float height_m, int width = 200) {
  return std::make_shared<const models::Relief>(
      *models::Relief::from_samples(Raster<float>(width, 160, height_m), kPixel_m));
}
double under_hand_m(const models::Relief& relief) { return relief.sample(kHand.v.x, kHand.v.y).z_m; }

TEST(RisingSurface, LiftsAHandByThirtyMillimetresASecondAndIsGoneAtOnce) {
  const auto high = plane(0.025F), low = plane(0.005F);
  auto shown = low;
  for (int k = 1; k <= 30; ++k) {
    shown = risen_surface(*shown, high, std::array{kHand}, 0.0, kFrame_s);
    EXPECT_NEAR(under_hand_m(*shown), std::min(0.025, 0.005 + 0.001 * k), 1e-5) << k;
    EXPECT_EQ(risen_surface(*shown, low, std::array{kHand}, 0.0, kFrame_s), low) << k;
  }
  EXPECT_EQ(shown, high);
}

// It meets the ball, 1 mm above the surface that is shown, in the tenth part of the picture's time.
TEST(RisingSurface, ComesToABallAtOnceAndLiftsItInTheRestOfThePicturesTime) {
  const Point<SceneFrame> hand{{kHand.v.x, kHand.v.y, 0.008}};
  const auto low = plane(0.005F), high = plane(0.015F);
  EXPECT_NEAR(under_hand_m(*risen_surface(*low, high, std::array{hand}, 0.002, kFrame_s)), 0.0069, 1e-5);
  const auto near = plane(0.0059F);
  EXPECT_EQ(risen_surface(*low, near, std::array{hand}, 0.002, kFrame_s), near);
}

TEST(RisingSurface, RisesAtOnceElsewhereByASlopeThatAHandCanClimb) {
  const auto risen = risen_surface(*plane(0.005F), plane(0.025F), std::array{kHand}, 0.0, kFrame_s);
  EXPECT_NEAR(risen->sample(kHand.v.x + 0.03, kHand.v.y).z_m, 0.025, 1e-6);
  double steepest = 0.0;
  for (double x = -0.04; x < 0.04; x += 0.0003) {
    const auto at = risen->sample(x, kHand.v.y + 0.001);
    steepest = std::max(steepest, std::hypot(at.dzdx, at.dzdy));
  }
  EXPECT_LT(steepest, 1.05);
}

TEST(RisingSurface, IsTheComingOneWhereNoHandIsLifted) {
  const auto low = plane(0.005F), high = plane(0.025F), little = plane(0.0055F);
  const Point<SceneFrame> above{{0.0, 0.0, 0.03}}, nowhere{{NAN, 0.0, 0.0}};
  EXPECT_EQ(risen_surface(*low, high, std::array{above, nowhere}, 0.0, kFrame_s), high);
  EXPECT_EQ(risen_surface(*low, high, {}, 0.0, kFrame_s), high);
  EXPECT_EQ(risen_surface(*low, little, std::array{kHand}, 0.0, kFrame_s), little);
  EXPECT_EQ(risen_surface(*plane(0.005F, 100), high, std::array{kHand}, 0.0, kFrame_s), high);
}

// However slowly pictures come.
TEST(RisingSurface, LiftsEachHandByThreeMillimetresAtMostInOnePicture) {
  const Point<SceneFrame> other{{-0.03, 0.02, 0.004}};
  const auto risen = risen_surface(*plane(0.005F), plane(0.025F), std::array{kHand, other}, 0.0, 10.0);
  EXPECT_NEAR(under_hand_m(*risen), 0.008, 1e-5);
  EXPECT_NEAR(risen->sample(other.v.x, other.v.y).z_m, 0.008, 1e-5);
}

}  // namespace
}  // namespace palpable::session
