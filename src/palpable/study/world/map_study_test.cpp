// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/study/world/map_study.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::study {
namespace {

TEST(Drive, TouchesNothingAndComesRound) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Room room = make_room(seed);
    const auto drive = drive_round(room);
    ASSERT_GT(drive.size(), 100U) << seed;
    double length_m = 0.0;
    for (std::size_t k = 0; k < drive.size(); ++k) {
      EXPECT_FALSE(touches(room, {drive[k].x_m, drive[k].y_m, 0.27}));
      if (k > 0) length_m += std::hypot(drive[k].x_m - drive[k - 1].x_m, drive[k].y_m - drive[k - 1].y_m);
    }
    EXPECT_GT(length_m, 5.0);
    EXPECT_LT(std::hypot(drive.back().x_m - drive.front().x_m, drive.back().y_m - drive.front().y_m), 0.2);
  }
}

TEST(Drive, OdometryDriftsByItsNoise) {
  const auto drive = drive_round(make_room(2));
  const auto same = odometry_of(drive, {0, 0, 0, 0, 0}, 1);
  EXPECT_NEAR(same.back().x_m, drive.back().x_m, 1e-9);
  EXPECT_NEAR(same.back().y_m, drive.back().y_m, 1e-9);
  const auto noisy = odometry_of(drive, {}, 1);
  EXPECT_EQ(noisy.front().x_m, drive.front().x_m);
  EXPECT_GT(std::hypot(noisy.back().x_m - drive.back().x_m, noisy.back().y_m - drive.back().y_m), 0.05);
}

/// The beginning of a drive with a small picture, so that the test is quick: its pixels are three times as
/// wide, and edges are that much coarser. The figures of whole drives are in docs/history.
TEST(MapStudy, TheMapOfADriveIsNearTheTruth) {
  MapStudyOptions options;
  options.camera = camera_of(120, 90, 1.05);
  options.most_frames = 40;
  const auto run = run_map_study(3, options);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->score.frames, 40);
  EXPECT_GT(run->score.right_4cm, 0.93);
  EXPECT_GT(run->score.kept_4cm, 0.85);
  EXPECT_LT(run->score.worst_place_m, 0.03);
  EXPECT_LT(run->score.depth_rms_percent, 9.0);
}

}  // namespace
}  // namespace palpable::study
