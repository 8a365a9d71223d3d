// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/walk.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

TEST(Walk, TurnsAheadWithTheExplorer) {
  // The explorer faces left: a hand 30 mm ahead and 10 mm to the right is left of the explorer and above.
  const auto scene_from = scene_from_explorer({0.1, 0.2, 0.5 * std::numbers::pi});
  const Vec3 p = (scene_from * Point<ExplorerFrame>{{0.01, 0.03, 0.005}}).v;
  EXPECT_NEAR(p.x, 0.07, 1e-12);
  EXPECT_NEAR(p.y, 0.21, 1e-12);
  EXPECT_NEAR(p.z, 0.005, 1e-12);
}

TEST(Walk, MovesTheDevicesCentreAndKeepsItsScaleAndHeight) {
  Transform<SceneFrame, DeviceFrame> laid_out;
  laid_out.scale = 2.0;
  laid_out.translation_m = {0.5, 0.6, 0.007};
  const auto place = with_explorer(laid_out, {0.1, 0.2, std::numbers::pi});
  const Vec3 p = (place * Point<DeviceFrame>{{0.0, 0.01, 0.001}}).v;
  EXPECT_NEAR(p.x, 0.1, 1e-12);
  EXPECT_NEAR(p.y, 0.18, 1e-12);
  EXPECT_NEAR(p.z, 0.009, 1e-12);
}

TEST(Walk, StandsWhereItsLastStepLed) {
  const std::array walk{WalkStep{1.0, {0.1, 0.0, 0.0}}, WalkStep{2.0, {0.2, 0.0, 0.0}}};
  EXPECT_EQ(pose_at(walk, 0.0).x_m, 0.1);
  EXPECT_EQ(pose_at(walk, 1.999).x_m, 0.1);
  EXPECT_EQ(pose_at(walk, 2.0).x_m, 0.2);
  EXPECT_EQ(pose_at(walk, 9.0).x_m, 0.2);
}

TEST(Walk, RefusesInvalidWalks) {
  EXPECT_FALSE(check_walk({}));
  EXPECT_FALSE(check_walk(std::array{WalkStep{0.0, {}}, WalkStep{0.0, {}}}));
  EXPECT_FALSE(check_walk(std::array{WalkStep{0.0, {NAN, 0.0, 0.0}}}));
  EXPECT_TRUE(check_walk(std::array{WalkStep{0.0, {}}, WalkStep{0.5, {0.1, 0.1, 7.0}}}));
}

TEST(Walk, IsSaidInWords) {
  EXPECT_EQ(words_of({}), "You stand in the middle, facing up.");
  EXPECT_EQ(words_of({0.02, -0.005, 0.5 * std::numbers::pi}),
            "You stand 20 millimetres right of and 5 millimetres below the middle, facing left.");
  EXPECT_EQ(words_of({-0.001, 0.0, -0.25 * std::numbers::pi}),
            "You stand 1 millimetre left of the middle, facing up and right.");
  EXPECT_EQ(words_of({0.0, 0.0, std::numbers::pi / 12.0}),
            "You stand in the middle, facing up, turned 15 degrees left.");
}

}  // namespace
}  // namespace palpable::session
