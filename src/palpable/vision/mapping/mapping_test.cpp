// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/mapping/camera_memory.hpp"
#include "palpable/vision/mapping/followed_view.hpp"
#include "palpable/vision/mapping/map_view.hpp"
#include "palpable/vision/mapping/pixel_planes.hpp"
#include "palpable/vision/mapping/view_warp.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

using Pose = Transform<WorldFrame, CameraFrame>;

constexpr Pinhole kCamera{80, 80, 39.5, 29.5, 80, 60};

const PoseMatrix kExpected = independent_errors({0.02, 0.02, 0.02}, {0.02, 0.02, 0.02});

/// A camera at `place`, turned about y by `turn_rad`.
Pose camera_at(Vec3 place, double turn_rad = 0.0) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  return {{c, 0, s, 0, 1, 0, -s, 0, c}, place, 1.0};
}

/// The corner of a room, x = 0.6, y = 0.4 and z = 2, and a plate at z = `plate_m` with |x|, |y| < 0.25.
Raster<float> corner_from(const Pose& pose, double plate_m = 100.0) {
  Raster<float> depth_m(kCamera.width, kCamera.height);
  for (int y = 0; y < kCamera.height; ++y)
    for (int x = 0; x < kCamera.width; ++x) {
      const Vec3 d = pose.rotate({(x - kCamera.cx) / kCamera.fx, (y - kCamera.cy) / kCamera.fy, 1.0});
      const Vec3 o = pose.translation_m;
      double t = (2.0 - o.z) / d.z;
      if (d.x > 0.0) t = std::min(t, (0.6 - o.x) / d.x);
      if (d.y > 0.0) t = std::min(t, (0.4 - o.y) / d.y);
      const double plate = (plate_m - o.z) / d.z;
      const Vec3 p = o + plate * d;
      if (std::abs(p.x) < 0.25 && std::abs(p.y) < 0.25) t = std::min(t, plate);
      depth_m(x, y) = static_cast<float>(t);
    }
  return depth_m;
}

void add(SurfaceMap& map, const Pose& pose, double time_s, double plate_m = 100.0) {
  map.add({corner_from(pose, plate_m), kCamera, pose}, time_s);
}

TEST(SurfaceMap, KeepsPlanesWhereTheyAre) {
  SurfaceMap map({});
  for (int k = 0; k < 5; ++k) add(map, camera_at({0.05 * k, 0, 0}, 0.1 * k), 0.1 * k);
  const auto on_wall = map.sample({{0.3, 0.2, 1.99}});
  ASSERT_TRUE(on_wall);
  EXPECT_NEAR(on_wall->distance_m, 0.01, 0.002);
  EXPECT_NEAR(on_wall->gradient.z, -1.0, 0.1);
  EXPECT_FALSE(map.sample({{0.3, 0.2, 1.5}}));
  EXPECT_FALSE(map.sample({{0.3, 0.2, 2.5}}));
  const auto surface = map.surface();
  EXPECT_GT(surface.size(), 5000U);
  for (const SurfacePoint& p : surface) {
    const double off = std::min(
        {std::abs(p.position_m.x - 0.6), std::abs(p.position_m.y - 0.4), std::abs(p.position_m.z - 2.0)});
    EXPECT_LT(off, 0.02);
  }
}

TEST(SurfaceMap, ForgetsWhatVanishedWhenRaysPassThroughItsPlace) {
  SurfaceMap map({});
  const Pose pose = camera_at({0, 0, 0});
  for (int k = 0; k < 10; ++k) add(map, pose, 0.1 * k, 1.2);
  EXPECT_NEAR(view_of(map, pose, kCamera).depth_m(40, 30), 1.2, 0.005);
  for (int k = 10; k < 16; ++k) add(map, pose, 0.1 * k);
  EXPECT_NEAR(view_of(map, pose, kCamera).depth_m(40, 30), 2.0, 0.005);
}

TEST(SurfaceMap, KeepsWhatIsHiddenNow) {
  SurfaceMap map({});
  const Pose pose = camera_at({0, 0, 0});
  for (int k = 0; k < 5; ++k) add(map, pose, 0.1 * k);
  for (int k = 5; k < 10; ++k) add(map, pose, 0.1 * k, 1.2);
  EXPECT_NEAR(map.sample({{0, 0, 2.0}})->distance_m, 0.0, 0.002);
  EXPECT_NEAR(map.seen_s({0, 0, 2.0}), 0.4, 0.11);
  EXPECT_NEAR(map.seen_s({0, 0, 1.2}), 0.9, 0.11);
}

TEST(SurfaceMap, ForgetsWhatIsOldAndStaysWithinItsMemory) {
  SurfaceMapOptions options;
  options.forget_s = 10.0;
  options.most_blocks = 100;
  SurfaceMap map(options);
  for (int k = 0; k < 20; ++k) add(map, camera_at({-1.0 * k, 0, 0}), 0.1 * k);
  EXPECT_FALSE(map.surface().empty());
  EXPECT_LT(map.bytes(), 1'000'000U);
  // A picture without surface in reach.
  map.add({Raster<float>(80, 60, 0.5F), kCamera, camera_at({500, 0, 0})}, 30.0);
  for (const SurfacePoint& p : map.surface()) EXPECT_GT(p.position_m.x, 400.0);
}

TEST(MapView, ShowsTheMapFromElsewhereWithTheTimeOfItsParts) {
  SurfaceMap map({});
  add(map, camera_at({0, 0, 0}), 1.0);
  add(map, camera_at({0, 0, 0}), 5.0);
  const Pose other = camera_at({0.2, 0.05, 0.1}, 0.15);
  const MapView view = view_of(map, other, kCamera);
  const Raster<float> truth = corner_from(other);
  int known = 0;
  for (std::size_t k = 0; k < truth.count(); ++k) {
    const float z = view.depth_m.values()[k];
    if (std::isnan(z)) continue;
    ++known;
    EXPECT_NEAR(z, truth.values()[k], 0.05);
    EXPECT_NEAR(view.seen_s.values()[k], 5.0, 0.11);
  }
  EXPECT_GT(known, 3000);
  // What is known already is not looked for.
  const MapView none = view_of(map, other, kCamera, truth);
  EXPECT_TRUE(std::all_of(none.depth_m.values().begin(), none.depth_m.values().end(),
                          [](float z) { return std::isnan(z); }));
}

TEST(Alignment, FindsThePoseFromTheSurfaces) {
  SurfaceMap map({});
  for (int k = 0; k < 3; ++k) add(map, camera_at({0, 0, 0}), 0.1 * k);
  const Pose truth = camera_at({0.02, -0.015, 0.02}, 0.02);
  const AlignedPose found = aligned(map, {corner_from(truth), kCamera, camera_at({0, 0, 0})}, kExpected);
  ASSERT_TRUE(found.found);
  EXPECT_GT(found.matched, 0.8);
  EXPECT_LT(norm(found.world_from_camera.translation_m - truth.translation_m), 0.002);
  EXPECT_NEAR(found.world_from_camera.rotation[2], std::sin(0.02), 0.003);
}

TEST(Alignment, LeavesTheExpectedPoseWhereNothingMatches) {
  SurfaceMap map({});
  add(map, camera_at({0, 0, 0}), 0.0);
  const Pose expected = camera_at({0.01, 0, 0});
  const AlignedPose found = aligned(map, {Raster<float>(80, 60, 0.7F), kCamera, expected}, kExpected);
  EXPECT_FALSE(found.found);
  EXPECT_EQ(found.world_from_camera.translation_m, expected.translation_m);
}

TEST(CameraMemory, CorrectsOdometry) {
  CameraMemory memory({});
  for (int k = 0; k < 20; ++k) {
    const Pose truth = camera_at({0.02 * k, 0, 0}, 0.02 * k);
    // Odometry overstates by a tenth.
    const auto found = memory.locate(corner_from(truth), kCamera, camera_at({0.022 * k, 0, 0}, 0.022 * k));
    ASSERT_TRUE(found);
    EXPECT_LT(norm(found->translation_m - truth.translation_m), 0.01) << k;
    memory.add(corner_from(truth), kCamera, *found, 0.1 * k);
  }
}

/// On a floor (z up): before a bare wall alone, so that nothing but odometry says where the camera is along
/// it and how high.
TEST(CameraMemory, KeepsHeightAndTiltOfARobotBeforeABareWall) {
  CameraMemory memory({});
  std::mt19937_64 random(1);
  std::normal_distribution<float> normal;
  // Looks along the world's y axis.
  const auto at = [](double x_m) { return Pose{{1, 0, 0, 0, 0, 1, 0, -1, 0}, {x_m, 0.0, 1.0}, 1.0}; };
  for (int k = 0; k < 60; ++k) {
    Raster<float> wall_m(kCamera.width, kCamera.height, 1.0F);
    for (float& z : wall_m.values()) z += 0.002F * normal(random);
    const auto found = memory.locate(wall_m, kCamera, at(0.02 * k));
    ASSERT_TRUE(found);
    EXPECT_NEAR(found->translation_m.z, 1.0, 0.005) << k;
    EXPECT_NEAR(found->translation_m.x, 0.02 * k, 0.02) << k;
    EXPECT_NEAR(found->rotation[5], 1.0, 1e-3) << k;
    memory.add(wall_m, kCamera, *found, 0.1 * k);
  }
  EXPECT_EQ(memory.closed(), 0);
}

TEST(PoseChain, SpreadsAnErrorOverTheMotionsByTheirUncertainty) {
  PoseChain chain({});
  const auto camera = [](double x_m) { return camera_at({x_m, 0, 0}); };
  const Raster<float> depth_m(kCamera.width, kCamera.height, 1.0F);
  const auto error = [](double position_m) {
    return independent_errors({1e-4, 1e-4, 1e-4}, {position_m, position_m, position_m});
  };
  chain.keep({depth_m, kCamera, camera(0.0)}, 0.0);
  chain.move(camera(0.0), camera(1.0), error(0.001));
  chain.keep({depth_m, kCamera, camera(1.0)}, 1.0);
  chain.move(camera(1.0), camera(2.0), error(0.1));
  chain.keep({depth_m, kCamera, camera(2.0)}, 2.0);
  // It did not move enough to be kept.
  chain.keep({depth_m, kCamera, camera(2.01)}, 2.1);
  ASSERT_EQ(chain.pictures().size(), 3U);
  chain.close(camera(2.0), camera(2.2));
  const auto x_m = [&](std::size_t k) { return chain.pictures()[k].posed.world_from_camera.translation_m.x; };
  EXPECT_EQ(x_m(0), 0.0);
  EXPECT_NEAR(x_m(1), 1.0, 1e-3);
  EXPECT_NEAR(x_m(2), 2.2, 1e-3);
  for (const double value : chain.drift()) EXPECT_EQ(value, 0.0);
}

TEST(CameraMemory, FindsItsWayWithoutStatedPoses) {
  CameraMemory memory({});
  for (int k = 0; k < 20; ++k) {
    const Pose truth = camera_at({0.01 * k, 0, 0.005 * k}, 0.01 * k);
    const auto found = memory.locate(corner_from(truth), kCamera, std::nullopt);
    ASSERT_TRUE(found) << k;
    EXPECT_LT(norm(found->translation_m - truth.translation_m), 0.01) << k;
    memory.add(corner_from(truth), kCamera, *found, 0.1 * k);
  }
  // Covered by a hand: lost, and found again.
  EXPECT_FALSE(memory.locate(Raster<float>(80, 60, 0.3F), kCamera, std::nullopt));
  EXPECT_TRUE(memory.locate(corner_from(camera_at({0.19, 0, 0.095}, 0.19)), kCamera, std::nullopt));
}

TEST(PixelPlanes, AreThoseOfTheSurface) {
  // The plane z = 1 + x: its normal is at 45 degrees to the middle ray.
  Raster<float> depth_m(21, 21);
  const Pinhole camera{20, 20, 10, 10, 21, 21};
  for (int y = 0; y < 21; ++y)
    for (int x = 0; x < 21; ++x) depth_m(x, y) = static_cast<float>(1.0 / (1.0 - (x - 10) / 20.0));
  const PixelPlane plane = pixel_planes(depth_m, camera)(10, 10);
  EXPECT_NEAR(plane.facing, std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(plane.inverse, 1.0, 1e-6);
  EXPECT_NEAR(plane.by_x, -0.05, 1e-6);
  EXPECT_NEAR(plane.by_y, 0.0, 1e-6);
  EXPECT_EQ(pixel_planes(Raster<float>(21, 21, kUnknownDepth), camera)(3, 4).inverse, 0.0F);
}

TEST(ViewWarp, ShowsSurfacesFromAnotherPlace) {
  const Pose from = camera_at({0, 0, 0});
  const Pose to = camera_at({0.1, 0, 0.1}, 0.1);
  const Raster<float> depth_m = corner_from(from, 1.2);
  EXPECT_EQ(seen_from(depth_m, kCamera, {}, kCamera), depth_m);
  const Raster<float> seen = seen_from(depth_m, kCamera, to.inverse() * from, kCamera);
  const Raster<float> truth = corner_from(to, 1.2);
  int known = 0, right = 0;
  for (std::size_t k = 0; k < truth.count(); ++k) {
    const float z = seen.values()[k];
    if (std::isnan(z)) continue;
    ++known;
    right += std::abs(z - truth.values()[k]) < 0.02F ? 1 : 0;
  }
  EXPECT_GT(known, 3200);
  // But for a pixel along the edges.
  EXPECT_GT(right, 0.96 * known);
}

TEST(FollowedView, RestsWhileTheCameraLooksAroundAndFollowsWhereItGoes) {
  FollowedView view;
  view.add(camera_at({0, 0, 0}), 0.0);
  for (int k = 0; k < 10; ++k) view.add(camera_at({0.02 * k, 0, 0}, 0.03 * k), 0.1);
  EXPECT_EQ(view.add(camera_at({0, 0, 0}), 0.1).translation_m, Vec3{});
  double before = 0.0;
  for (int k = 0; k < 100; ++k) {
    const double x = view.add(camera_at({1, 0, 0}, 1.0), 0.1).translation_m.x;
    EXPECT_LE(x - before, 0.1);
    before = x;
  }
  EXPECT_NEAR(before, 1.0, 0.021);
}

}  // namespace
}  // namespace palpable::vision
