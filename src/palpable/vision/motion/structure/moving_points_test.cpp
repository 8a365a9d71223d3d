// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/moving_points.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kFrames = 20;

// A camera that goes round the origin by 0.4 radians.
CameraMotion round_the_origin() {
  CameraMotion out;
  out.camera = kExactCamera;
  for (int i = 0; i < kFrames; ++i) out.poses.emplace_back(facing_origin(0.4 * i / (kFrames - 1)));
  return out;
}

// A point that begins at `place` and moves by `step` from frame to frame.
PointTrack track_of(const CameraMotion& motion, Vec3 place, Vec3 step, int frames = kFrames) {
  PointTrack out;
  for (int i = 0; i < frames; ++i)
    out.places.push_back(seen_from(*motion.poses[static_cast<std::size_t>(i)], place + i * step));
  return out;
}

TEST(MovingPoints, AreToldFromThoseThatStay) {
  const CameraMotion motion = round_the_origin();
  std::vector<PointTrack> tracks;
  for (const Vec3& place : points_around_origin(30)) tracks.push_back(track_of(motion, place, {}));
  EXPECT_EQ(moving_points(tracks, motion, {}).judged, 30);
  EXPECT_EQ(moving_points(tracks, motion, {}).moving, 0);
  // A hand that moves by 8 mm a frame across the line of sight, upwards.
  for (const Vec3& place : points_around_origin(10)) tracks.push_back(track_of(motion, place, {0, 0.008, 0}));
  const MovingPoints found = moving_points(tracks, motion, {});
  EXPECT_EQ(found.judged, 40);
  EXPECT_EQ(found.moving, 10);
  EXPECT_DOUBLE_EQ(found.share(), 0.25);
}

TEST(MovingPoints, IncludeWhatMovesWithTheCamera) {
  CameraMotion motion = round_the_origin();
  // The camera also rises, so that no point far away explains a place of the picture that stays.
  for (int i = 0; i < kFrames; ++i) motion.poses[static_cast<std::size_t>(i)]->translation_m.y = 0.02 * i;
  PointTrack finger;
  finger.places.assign(kFrames, ImagePoint{100, 400});
  EXPECT_EQ(moving_points(std::vector{finger}, motion, {}).moving, 1);
}

TEST(MovingPoints, AreNotJudgedWhereFewFramesOrSmallAnglesSayLittle) {
  CameraMotion motion = round_the_origin();
  const Vec3 step{0, 0.02, 0};
  EXPECT_EQ(moving_points(std::vector{track_of(motion, {}, step, 5)}, motion, {}).judged, 0);
  // Poses that are not known do not count.
  const auto all = std::vector{track_of(motion, {}, step)};
  EXPECT_EQ(moving_points(all, motion, {}).judged, 1);
  for (int i = 5; i < kFrames; ++i) motion.poses[static_cast<std::size_t>(i)].reset();
  EXPECT_EQ(moving_points(all, motion, {}).judged, 0);
  // A point that stays, seen from one place, may be anywhere on its line of sight.
  for (auto& pose : motion.poses) pose = facing_origin(0.0);
  EXPECT_EQ(moving_points(std::vector{track_of(motion, {}, {})}, motion, {}).judged, 0);
  EXPECT_EQ(moving_points({}, motion, {}).share(), 0.0);
}

}  // namespace
}  // namespace palpable::vision
