// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/session/touch/live_memory.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::session {
namespace {

using Pose = Transform<WorldFrame, CameraFrame>;

constexpr Pinhole kCamera{80, 80, 39.5, 29.5, 80, 60};

Pose turned(double turn_rad) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  return {{c, 0, s, 0, 1, 0, -s, 0, c}, {}, 1.0};
}

/// A camera, turned so far, before a wall at z = 1.5 m with a step to 1.3 m at x = 0, and a floor at y = 0.6.
LiveFrame frame_of(double turn_rad) {
  LiveFrame frame;
  frame.world_from_camera = turned(turn_rad);
  frame.depth.camera = kCamera;
  frame.depth.depth_m = Raster<float>(kCamera.width, kCamera.height);
  for (int y = 0; y < kCamera.height; ++y)
    for (int x = 0; x < kCamera.width; ++x) {
      const Vec3 d =
          turned(turn_rad).rotate({(x - kCamera.cx) / kCamera.fx, (y - kCamera.cy) / kCamera.fy, 1.0});
      double t = (d.x < 0.0 ? 1.3 : 1.5) / d.z;
      if (d.y > 0.0) t = std::min(t, 0.6 / d.y);
      frame.depth.depth_m(x, y) = static_cast<float>(t);
    }
  return frame;
}

TEST(LiveMemory, KeepsTheSurfaceWhereTheCameraNoLongerLooks) {
  LiveMemory memory({});
  const LiveFrame first = frame_of(0.0);
  for (int k = 0; k < 10; ++k) {
    Raster<float> seen = memory.live_view(first, first.depth.depth_m, 1, 0.1 * k);
    const auto labels = memory.fill(seen);
    EXPECT_EQ(seen, first.depth.depth_m);
    EXPECT_EQ(labels, Raster<std::uint8_t>(80, 60, 0));
    memory.learn();
  }
  // It looks to the right by 17 degrees, where the view does not follow yet: its left quarter is memory.
  for (int k = 1; k <= 10; ++k) {
    const LiveFrame frame = frame_of(0.03 * k);
    Raster<float> seen = memory.live_view(frame, frame.depth.depth_m, 1, 1.0 + 0.1 * k);
    EXPECT_TRUE(k < 5 || std::isnan(seen(2, 20)));
    const auto labels = memory.fill(seen);
    memory.learn();
    if (k < 10) continue;
    EXPECT_NEAR(seen(2, 20), first.depth.depth_m(2, 20), 0.02);
    EXPECT_EQ(labels(2, 20), 1);
    EXPECT_NEAR(seen(70, 20), first.depth.depth_m(70, 20), 0.02);
    EXPECT_EQ(labels(70, 20), 0);
    EXPECT_GT(memory.remembered_share(), 0.15);
    EXPECT_LT(memory.remembered_share(), 0.45);
  }
  EXPECT_GT(memory.map_mib(), 0.1);
  EXPECT_EQ(memory.lost(), 0U);
}

TEST(LiveMemory, BeginsAnewWhenItsCameraIsStatedLate) {
  LiveMemory memory({});
  for (int k = 0; k < 20; ++k) {
    LiveFrame frame = frame_of(0.0);
    frame.world_from_camera.reset();
    // A camera of half the assumed focal length is stated from the third picture on.
    frame.depth.camera.reset();
    if (k >= 2) frame.depth.camera = Pinhole{35, 35, 39.5, 29.5, 80, 60};
    Raster<float> seen = memory.live_view(frame, frame.depth.depth_m, 1, 0.1 * k);
    static_cast<void>(memory.fill(seen));
    memory.learn();
  }
  EXPECT_EQ(memory.lost(), 0U);
}

TEST(LiveMemory, SaysHowLongAgo) {
  const auto materials = memory_materials();
  EXPECT_EQ(materials.at(memory_label(2.0)).name, "memory, seen a few seconds ago");
  EXPECT_EQ(materials.at(memory_label(12.0)).name, "memory, seen about 10 seconds ago");
  EXPECT_EQ(materials.at(memory_label(70.0)).name, "memory, seen about a minute ago");
  EXPECT_EQ(memory_label(1e6) + 1U, materials.size());
  EXPECT_EQ(materials[0].texture.kind, models::TouchTexture::Kind::none);
  EXPECT_NE(materials[1].texture.kind, models::TouchTexture::Kind::none);
}

}  // namespace
}  // namespace palpable::session
