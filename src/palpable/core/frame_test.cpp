// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/frame.hpp"

#include <cmath>
#include <numbers>
#include <random>
#include <type_traits>

#include <gtest/gtest.h>

namespace palpable {
namespace {

// tests/compile/frames.cpp holds what must not compile.
static_assert(std::is_trivially_copyable_v<Vec3> && std::is_trivially_copyable_v<Point<SceneFrame>> &&
              std::is_trivially_copyable_v<Transform<SceneFrame, DeviceFrame>>);

void expect_near(Vec3 a, Vec3 b, double tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

/// A rotation about a random axis (Rodrigues' formula), a translation of up to 1 m along each axis, and a
/// scale of 1/4 to 4.
template <class To, class From>
Transform<To, From> random_similarity(std::mt19937& random) {
  std::uniform_real_distribution<double> side(-1.0, 1.0);
  const auto vec3 = [&] { return Vec3{side(random), side(random), side(random)}; };
  const Vec3 k = unit(vec3());
  const double angle = std::numbers::pi * side(random);
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  const auto turned = [&](Vec3 p) { return c * p + s * cross(k, p) + (1.0 - c) * dot(k, p) * k; };
  const Vec3 x = turned({1, 0, 0});
  const Vec3 y = turned({0, 1, 0});
  const Vec3 z = turned({0, 0, 1});
  return {{x.x, y.x, z.x, x.y, y.y, z.y, x.z, y.z, z.z}, vec3(), std::exp2(2.0 * side(random))};
}

TEST(Vec3, CrossFollowsTheRightHand) {
  EXPECT_EQ(cross(Vec3{1, 0, 0}, Vec3{0, 1, 0}), (Vec3{0, 0, 1}));
  EXPECT_EQ(cross(Vec3{0, 1, 0}, Vec3{0, 0, 1}), (Vec3{1, 0, 0}));
}

TEST(Vec3, UnitOfZeroIsZeroAndOtherwiseHasLengthOne) {
  EXPECT_EQ(unit(Vec3{}), Vec3{});
  EXPECT_DOUBLE_EQ(norm(unit(Vec3{3, -4, 12})), 1.0);
}

TEST(Vec3, IsFiniteOnlyIfEveryPartIs) {
  EXPECT_TRUE(is_finite(Vec3{1, 2, 3}));
  EXPECT_FALSE(is_finite(Vec3{NAN, 2, 3}));
  EXPECT_FALSE(is_finite(Vec3{1, INFINITY, 3}));
  EXPECT_FALSE(is_finite(Vec3{1, 2, -INFINITY}));
}

TEST(Frame, PointsDifferByVectors) {
  const Point<SceneFrame> a{{1, 2, 3}};
  const Vector<SceneFrame> step{{0.5, 0, -1}};
  EXPECT_EQ((a + step) - a, step);
  EXPECT_EQ((a - step) + step, a);
}

TEST(Transform, ActsOnAPointAsItsFormulaSays) {
  // A quarter turn about z takes x to y.
  const Transform<SceneFrame, DeviceFrame> scene_from_device{{0, -1, 0, 1, 0, 0, 0, 0, 1}, {10, 20, 30}, 2.0};
  EXPECT_EQ(scene_from_device * Point<DeviceFrame>({1, 0, 0}), (Point<SceneFrame>{{10, 22, 30}}));
}

TEST(Transform, DoesNotTranslateVectors) {
  const Transform<SceneFrame, DeviceFrame> scene_from_device{{0, -1, 0, 1, 0, 0, 0, 0, 1}, {10, 20, 30}, 2.0};
  EXPECT_EQ(scene_from_device * Vector<DeviceFrame>({1, 0, 0}), (Vector<SceneFrame>{{0, 2, 0}}));
}

TEST(Transform, KeepsTheSizeOfAForceInALargerScene) {
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    const auto scene_from_device = random_similarity<SceneFrame, DeviceFrame>(random);
    const Vector<DeviceFrame> force_N{{1, -2, 0.5}};
    EXPECT_NEAR(norm(rotate_force(scene_from_device, force_N)), norm(force_N), 1e-12);
  }
}

TEST(Transform, InverseRestoresEveryPoint) {
  std::mt19937 random(2);
  for (int i = 0; i < 100; ++i) {
    const auto scene_from_device = random_similarity<SceneFrame, DeviceFrame>(random);
    const Point<DeviceFrame> p{{0.03, -0.04, 0.01}};
    expect_near((scene_from_device.inverse() * (scene_from_device * p)).v, p.v, 1e-12);
  }
}

TEST(Transform, AppliesTheRightFactorFirst) {
  std::mt19937 random(3);
  for (int i = 0; i < 100; ++i) {
    const auto world_from_camera = random_similarity<WorldFrame, CameraFrame>(random);
    const auto scene_from_world = random_similarity<SceneFrame, WorldFrame>(random);
    const Point<CameraFrame> p{{0.2, -0.1, 1.5}};
    const Vector<CameraFrame> v{{-1, 0.5, 0.25}};
    const auto scene_from_camera = scene_from_world * world_from_camera;
    expect_near((scene_from_camera * p).v, (scene_from_world * (world_from_camera * p)).v, 1e-12);
    expect_near((scene_from_camera * v).v, (scene_from_world * (world_from_camera * v)).v, 1e-12);
  }
}

TEST(Transform, KeepsAnglesAndHandedness) {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const auto t = random_similarity<SceneFrame, WorldFrame>(random);
    const Vector<WorldFrame> a{{1, 2, 3}};
    const Vector<WorldFrame> b{{-2, 0.5, 1}};
    EXPECT_NEAR(dot(t * a, t * b), t.scale * t.scale * dot(a, b), 1e-11);
    expect_near(cross(t * a, t * b).v, (t.scale * (t * cross(a, b))).v, 1e-11);
  }
}

}  // namespace
}  // namespace palpable
