// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/rolled_pictures.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kFrames = 5;

// A camera that moves sideways and turns, above the plane z = 0.
CameraPose pose_at_time(double time) {
  CameraPose pose = facing_origin(0.03 * time);
  pose.translation_m.y += 0.004 * time;
  return pose;
}

// The plane's brightness, smooth.
std::uint8_t level_at(double x, double y) {
  return static_cast<std::uint8_t>(std::lround(128 + 60 * std::sin(90 * x) + 50 * std::cos(80 * y)));
}

Raster<Rgb8> picture_of(double frame, double readout) {
  const Pinhole& camera = kExactCamera;
  Raster<Rgb8> out(camera.width, camera.height);
  for (int y = 0; y < camera.height; ++y) {
    const CameraPose pose = pose_at_time(frame + readout * ((y + 0.5) / camera.height - 0.5));
    for (int x = 0; x < camera.width; ++x) {
      const Vec3 ray = pose.rotate({(x - camera.cx) / camera.fx, (y - camera.cy) / camera.fy, 1});
      const Vec3 p = pose.translation_m - pose.translation_m.z / ray.z * ray;
      const std::uint8_t level = level_at(p.x, p.y);
      out(x, y) = {level, level, level};
    }
  }
  return out;
}

double mean_difference(const Raster<Rgb8>& a, const Raster<Rgb8>& b) {
  double sum = 0.0, count = 0.0;
  for (int y = 10; y + 10 < a.height(); ++y)
    for (int x = 10; x + 10 < a.width(); ++x) sum += std::abs(a(x, y).r - b(x, y).r), ++count;
  return sum / count;
}

CameraMotion motion_over_plane(double readout) {
  CameraMotion out;
  out.camera = kExactCamera;
  out.readout = {readout, 0};
  for (int k = 0; k < kFrames; ++k) out.poses.emplace_back(pose_at_time(k));
  for (const Vec3& p : points_around_origin(100)) out.points.push_back({{{p.x, p.y, 0}}, 0});
  return out;
}

TEST(RolledPictures, AreWhatACameraWithoutRollingShutterShows) {
  constexpr double kReadout = 0.6;
  const Raster<Rgb8> rolled = picture_of(2, kReadout), truth = picture_of(2, 0);
  const auto moved =
      without_rolling_shutter(rolled, motion_over_plane(kReadout), 2, consecutive_numbers(kFrames));
  EXPECT_GT(mean_difference(rolled, truth), 2.5);
  EXPECT_LT(mean_difference(moved, truth), 0.5);
}

TEST(RolledPictures, StayWhereThereIsNoRollingShutter) {
  const Raster<Rgb8> picture = picture_of(2, 0);
  EXPECT_EQ(without_rolling_shutter(picture, motion_over_plane(0), 2, consecutive_numbers(kFrames)), picture);
}

}  // namespace
}  // namespace palpable::vision
