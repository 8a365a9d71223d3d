// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/solid/world_orientation.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

using Pose = Transform<models::InputFrame, CameraFrame>;
using Rotation = std::array<double, 9>;

Pose pose(const Rotation& rotation) {
  Pose out;
  out.rotation = rotation;
  out.translation_m = {0.3, -0.1, 2.0};
  return out;
}

constexpr Rotation kKept{1, 0, 0, 0, 1, 0, 0, 0, 1};
/// The axes of a camera, rotated by a few degrees relative to the scene.
constexpr Rotation kTilted{1, 0, 0, 0, 0.98, -0.199, 0, 0.199, 0.98};

TEST(WorldOrientation, TurnsACamerasOwnWorldSoThatItLooksAwayFromTheUser) {
  EXPECT_EQ(scene_rotation_for(std::vector{pose(kKept)}), (Rotation{1, 0, 0, 0, -1, 0, 0, 0, -1}));
  EXPECT_EQ(scene_rotation_for(std::vector{pose(kTilted), pose(kTilted)}),
            (Rotation{1, 0, 0, 0, -1, 0, 0, 0, -1}));
}

TEST(WorldOrientation, KeepsAWorldInWhichCamerasAlreadyLookAlongMinusZ) {
  // World axes as the scene's: the camera's x is x, its y is -y, its z is -z.
  EXPECT_EQ(scene_rotation_for(std::vector{pose({1, 0, 0, 0, -1, 0, 0, 0, -1})}), kKept);
}

TEST(WorldOrientation, StandsAWorldWithZUpUpright) {
  // A robot's world: x forward, y left, z up; the camera looks along x.
  const Pose robot = pose({0, 0, 1, -1, 0, 0, 0, -1, 0});
  const Rotation r = scene_rotation_for(std::vector{robot});
  // The world's up becomes y, and its forward -z.
  EXPECT_EQ((std::array{r[2], r[5], r[8]}), (std::array{0.0, 1.0, 0.0}));
  EXPECT_EQ((std::array{r[0], r[3], r[6]}), (std::array{0.0, 0.0, -1.0}));
}

TEST(WorldOrientation, KeepsAWorldWithoutCameras) { EXPECT_EQ(scene_rotation_for({}), kKept); }

}  // namespace
}  // namespace palpable::recipes
