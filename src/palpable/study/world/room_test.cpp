// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/room.hpp"

#include "palpable/study/world/room_view.hpp"

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

constexpr double kPi = std::numbers::pi;

/// A room of 4 x 4 x 2 m with a box turned by 45 degrees, and a cylinder.
Room small_room() {
  Room room;
  room.size_m = {4, 4, 2};
  room.furniture.push_back({"box", {}, {{Solid::Shape::box, {1, 0, 0.5}, {0.2, 0.2, 0.5}, kPi / 4}}});
  room.furniture.push_back({"bin", {}, {{Solid::Shape::cylinder, {0, 1, 0.2}, {0.3, 0.3, 0.2}, 0}}});
  return room;
}

TEST(Room, RaysMeetTheFirstSurface) {
  const Room room = small_room();
  const auto along = [&](Vec3 from, Vec3 to) { return cast_ray(room, {from}, {to}).along; };
  EXPECT_NEAR(along({0, 0, 0.5}, {1, 0, 0}), 1 - 0.2 * std::numbers::sqrt2, 1e-12);
  EXPECT_NEAR(along({0, 0, 1.5}, {2, 0, 0}), 1.0, 1e-12);
  EXPECT_NEAR(along({0, 0, 0.1}, {0, 1, 0}), 0.7, 1e-12);
  EXPECT_NEAR(along({0, 1, 1}, {0, 0, -1}), 0.6, 1e-12);
  EXPECT_NEAR(along({0, 0, 1}, {0, 0, 1}), 1.0, 1e-12);
  EXPECT_EQ(cast_ray(room, {{0, 0, 0.1}}, {{0, 1, 0}}).object, 1);
  EXPECT_EQ(cast_ray(room, {{0, 0, 0.1}}, {{0, -1, 0}}).object, kWalls);
  EXPECT_NEAR(
      norm(cast_ray(room, {{0, 0, 0.5}}, {{1, 0.05, 0}}).normal - Vec3{-1, 1, 0} / std::numbers::sqrt2), 0.0,
      1e-12);
}

TEST(Room, DistancesAreExact) {
  const Room room = small_room();
  EXPECT_NEAR(distance_m(room, {{0, 0.5, 1}}), std::hypot(0.2, 0.6), 1e-12);
  EXPECT_NEAR(distance_m(room, {{-1.5, 0, 1}}), 0.5, 1e-12);
  EXPECT_NEAR(distance_m(room, {{1, 0, 0.9}}), -0.1, 1e-12);
  EXPECT_NEAR(distance_m(room, {{1, 0, 1.25}}), 0.25, 1e-12);
  EXPECT_NEAR(distance_m(room, {{-2.25, 0, 1}}), -0.25, 1e-12);
}

TEST(Room, WhatARayMeetsIsAtDistanceZero) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const Room room = make_room(seed);
    for (int k = 0; k < 200; ++k) {
      const double a = 0.1 * k;
      const Point<WorldFrame> from{{0.1 * std::cos(7.0 * k), 0.1 * std::sin(11.0 * k), 2.0}};
      const Vector<WorldFrame> direction{{std::cos(a), std::sin(a), -0.01 * k + 0.5}};
      const Hit hit = cast_ray(room, from, direction);
      EXPECT_NEAR(distance_m(room, from + hit.along * direction), 0.0, 1e-9);
      EXPECT_LT(dot(hit.normal, direction.v), 0.0);
    }
  }
}

TEST(Room, TellsWhatADiscTouches) {
  Room room = small_room();
  EXPECT_FALSE(touches(room, {0, 0, 0.69}));
  EXPECT_TRUE(touches(room, {0, 0, 0.71}));
  EXPECT_TRUE(touches(room, {-1.8, 0, 0.2}));
  // Below a board at 0.7 m.
  room.furniture.push_back({"board", {}, {{Solid::Shape::box, {-1, 0, 0.72}, {0.3, 0.3, 0.02}, 0}}});
  EXPECT_FALSE(touches(room, {-1, 0, 0.2, 0.5}));
  EXPECT_TRUE(touches(room, {-1, 0, 0.2}));
}

TEST(Room, FurnitureHasNamesOfItsOwnAndRoomAround) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const Room room = make_room(seed);
    std::set<std::string> names;
    for (const Furniture& f : room.furniture) {
      EXPECT_TRUE(names.insert(f.name).second) << f.name;
      const Vec3 c = centre_of(f).v;
      EXPECT_LT(std::abs(c.x), room.size_m.x / 2);
      EXPECT_LT(std::abs(c.y), room.size_m.y / 2);
      EXPECT_LT(top_m(f), room.size_m.z);
    }
    EXPECT_TRUE(names.contains("table"));
    EXPECT_GE(room.furniture.size(), 5U);
  }
}

TEST(Room, IsTheSameForTheSameSeed) {
  const Room a = make_room(7);
  const Room b = make_room(7);
  ASSERT_EQ(a.furniture.size(), b.furniture.size());
  EXPECT_EQ(a.size_m, b.size_m);
  for (std::size_t k = 0; k < a.furniture.size(); ++k)
    EXPECT_EQ(a.furniture[k].solids.front().centre_m, b.furniture[k].solids.front().centre_m);
  EXPECT_NE(a.size_m, make_room(8).size_m);
}

TEST(RoomView, DepthIsThatOfSingleRays) {
  const Room room = make_room(3);
  const auto pose = camera_pose({{0.1, -1.5, 1.1}}, 1.2, 0.2);
  const Pinhole camera = camera_of(64, 48, 1.2);
  const RoomView view = render(room, pose, camera);
  for (int y = 0; y < 48; y += 3)
    for (int x = 0; x < 64; x += 3) {
      const Vector<CameraFrame> ray{{(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1.0}};
      const Hit hit = cast_ray(room, {pose.translation_m}, pose * ray);
      EXPECT_NEAR(view.depth_m(x, y), hit.along, 1e-5);
      EXPECT_EQ(view.object(x, y), hit.object);
    }
}

TEST(RoomView, ALevelCameraSeesAWallAtItsDistance) {
  const Room room = small_room();
  // Towards -x.
  const RoomView view = render(room, camera_pose({{0, 0, 1}}, kPi, 0), camera_of(33, 25, 0.5));
  for (const float z : view.depth_m.values()) EXPECT_NEAR(z, 2.0, 1e-6);
  // Up in the picture is up in the world: tilted down, the floor is in the lower half.
  const RoomView down = render(room, camera_pose({{0, 0, 1}}, kPi, 0.5), camera_of(33, 25, 0.5));
  EXPECT_EQ(down.object(16, 24), kFloor);
  EXPECT_EQ(down.object(16, 0), kWalls);
}

TEST(RoomView, NoiseHasTheStatedDeviationAndRange) {
  const Room room = small_room();
  const auto pose = camera_pose({{0, 0, 1}}, kPi, 0);
  const Pinhole camera = camera_of(100, 80, 0.5);
  CameraNoise noise;
  noise.depth = {0.0, 0.0014};
  noise.seed = 5;
  const RoomView view = render(room, pose, camera, noise);
  double sum = 0, squares = 0;
  for (const float z : view.depth_m.values()) sum += z - 2.0, squares += (z - 2.0) * (z - 2.0);
  const auto n = static_cast<double>(view.depth_m.count());
  EXPECT_NEAR(sum / n, 0.0, 0.0003);
  EXPECT_NEAR(std::sqrt(squares / n), 0.0056, 0.0003);
  EXPECT_EQ(render(room, pose, camera, noise).depth_m, view.depth_m);
  noise.seed = 6;
  EXPECT_FALSE(render(room, pose, camera, noise).depth_m == view.depth_m);
  noise.far_m = 1.5;
  EXPECT_TRUE(std::isnan(render(room, pose, camera, noise).depth_m(50, 40)));
}

}  // namespace
}  // namespace palpable::study
