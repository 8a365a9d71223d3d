// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/first_pair.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <array>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

std::vector<PointTrack> tracks_of(const std::vector<CameraPose>& poses) {
  std::vector<PointTrack> out;
  for (const Vec3& point : points_around_origin(100)) {
    PointTrack track;
    for (const CameraPose& pose : poses) track.places.push_back(seen_from(pose, point));
    out.push_back(track);
  }
  return out;
}

TEST(FirstPair, HasTheRelativePoseOfItsCameras) {
  const std::vector<CameraPose> poses{facing_origin(0.0), facing_origin(0.005), facing_origin(0.3)};
  const auto found = choose_first_pair(tracks_of(poses), std::array{0, 1, 2}, kExactCamera, {}, {});
  ASSERT_TRUE(found) << found.error().sentence();
  // The first two are too close to each other for the angle of 1.5 degrees.
  EXPECT_EQ(found->second, 2);
  EXPECT_EQ(found->points, 100);
  const CameraPose& first = poses[static_cast<std::size_t>(found->first)];
  const auto truth = first.inverse() * poses[2];
  const CameraPose second = camera_pose(found->second_pose);
  for (std::size_t i = 0; i < 9; ++i) EXPECT_NEAR(second.rotation[i], truth.rotation[i], 1e-4);
  // Its length is arbitrary.
  EXPECT_NEAR(norm(unit(second.translation_m) - unit(truth.translation_m)), 0.0, 1e-3);
}

TEST(FirstPair, SaysThatTheCameraOnlyTurned) {
  std::vector<CameraPose> poses;
  for (const double angle : {0.0, 0.1, 0.2}) {
    poses.push_back(facing_origin(angle));
    poses.back().translation_m = {0, 0, -1};
  }
  const auto found = choose_first_pair(tracks_of(poses), std::array{0, 1, 2}, kExactCamera, {}, {});
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("only turned"), std::string::npos);
}

TEST(FirstPair, RefusesAZoomWithoutParallax) {
  // A picture that is enlarged about its middle, and a zoom during a small turn.
  for (const double turn : {0.0, 0.05}) {
    std::vector<CameraPose> poses;
    for (int i = 0; i < 3; ++i) {
      poses.push_back(facing_origin(i * turn));
      poses.back().translation_m = {0, 0, -1};
    }
    auto tracks = tracks_of(poses);
    for (PointTrack& track : tracks)
      for (std::size_t i = 0; i < track.places.size(); ++i) {
        const double zoom = 1.0 + 0.15 * static_cast<double>(i);
        track.places[i].x = kExactCamera.cx + zoom * (track.places[i].x - kExactCamera.cx);
        track.places[i].y = kExactCamera.cy + zoom * (track.places[i].y - kExactCamera.cy);
      }
    const auto found = choose_first_pair(tracks, std::array{0, 1, 2}, kExactCamera, {}, {});
    ASSERT_FALSE(found) << turn;
    EXPECT_NE(found.error().message.find("zoomed"), std::string::npos);
  }
}

TEST(FirstPair, SaysThatTheCameraDidNotMove) {
  const std::vector<CameraPose> poses(3, facing_origin(0.0));
  const auto found = choose_first_pair(tracks_of(poses), std::array{0, 1, 2}, kExactCamera, {}, {});
  ASSERT_FALSE(found);
  EXPECT_NE(found.error().message.find("did not move"), std::string::npos);
}

}  // namespace
}  // namespace palpable::vision
