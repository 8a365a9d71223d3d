// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/ground_axes.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace palpable::recipes {
namespace {

// A camera that looks down at a slope onto the ground: its world is its own frame, so the ground's normal is
// (0, -c, -s).
constexpr double kDown = 0.7;

TEST(GroundAxes, PointZOutOfThePlaneThatMostPointsLieOnAndYAway) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> side(-1, 1), height(0, 0.4);
  const double c = std::cos(kDown), s = std::sin(kDown);
  const Vec3 normal{0, -c, -s}, away{0, -s, c}, right{1, 0, 0};
  PointCloud cloud;
  for (int i = 0; i < 2000; ++i) {
    const double h = i % 4 == 0 ? height(random) : 0.0;
    cloud.places_m.push_back(Vec3{0, 0, 3} + side(random) * right + side(random) * away + h * normal);
  }
  const vision::CameraPose pose;
  const GroundAxes axes = ground_axes(cloud, std::span(&pose, 1), {}, 1);
  const Vec3 z = axes.axes_from_world().rotate(normal), y = axes.axes_from_world().rotate(away);
  EXPECT_NEAR(z.z, 1.0, 1e-3);
  EXPECT_NEAR(y.y, 1.0, 1e-3);
}

TEST(GroundAxes, OfGroundSeenFromStraightAboveHaveThePicturesUpAsY) {
  PointCloud cloud;
  for (int i = 0; i < 100; ++i) cloud.places_m.push_back({0.1 * (i % 10), 0.1 * (i / 10), 2.0});
  const vision::CameraPose pose;
  const GroundAxes axes = ground_axes(cloud, std::span(&pose, 1), {}, 1);
  const Vec3 up = axes.axes_from_world().rotate({0, -1, 0}),
             towards = axes.axes_from_world().rotate({0, 0, -1});
  EXPECT_NEAR(up.y, 1.0, 1e-9);
  EXPECT_NEAR(towards.z, 1.0, 1e-9);
}

TEST(GroundNormal, IsThatOfTheReconstructionsGroundTowardsTheCameras) {
  vision::CameraMotion motion;
  EXPECT_EQ(norm(ground_normal(motion, {}, 1)), 0.0);
  motion.poses = {std::nullopt, vision::CameraPose{}};
  for (int i = 0; i < 100; ++i)
    motion.points.push_back({{{0.1 * (i % 10), 0.1 * (i / 10), 2.0 + (i % 7 == 0 ? -0.3 : 0.0)}}, 0});
  EXPECT_NEAR(ground_normal(motion, {}, 1).z, -1.0, 1e-9);
}

}  // namespace
}  // namespace palpable::recipes
