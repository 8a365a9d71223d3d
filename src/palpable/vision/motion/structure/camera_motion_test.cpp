// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/camera_motion.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

using testing::HasSubstr;

constexpr Pinhole kCamera{500, 500, 319.5, 239.5, 640, 480};
constexpr int kMotionFrames = 30;

// A camera at distance 1 from the origin, at this angle, facing it; or one that stays in place and rotates by
// the angle.
CameraPose pose_at(double angle, bool turns_only) {
  CameraPose pose;
  const double c = std::cos(angle), s = std::sin(angle);
  pose.rotation = {c, 0, -s, 0, 1, 0, s, 0, c};
  pose.translation_m = turns_only ? Vec3{0, 0, -1} : Vec3{s, 0, -c};
  return pose;
}

struct SeenScene {
  std::vector<CameraPose> poses;
  std::vector<PointTrack> tracks;
};

// Points around the origin, observed by all cameras, with Gaussian noise.
SeenScene seen_from_arc(double arc, bool turns_only, double noise_px) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-0.25, 0.25);
  std::normal_distribution<double> noise(0.0, noise_px > 0 ? noise_px : 1.0);
  SeenScene out;
  for (int i = 0; i < kMotionFrames; ++i)
    out.poses.push_back(pose_at(arc * i / (kMotionFrames - 1), turns_only));
  for (int p = 0; p < 200; ++p) {
    const Point<WorldFrame> point{{place(random), place(random), place(random)}};
    PointTrack track;
    for (const CameraPose& pose : out.poses) {
      const Vec3 v = (pose.inverse() * point).v;
      const double dx = noise_px > 0 ? noise(random) : 0, dy = noise_px > 0 ? noise(random) : 0;
      track.places.push_back(
          {kCamera.fx * v.x / v.z + kCamera.cx + dx, kCamera.fy * v.y / v.z + kCamera.cy + dy});
    }
    out.tracks.push_back(track);
  }
  return out;
}

// Compares with the truth: the angle between the cameras of two frames, and the ratios of the path's length
// between three frames.
void expect_same_path(const CameraMotion& motion, const SeenScene& truth, double tolerance) {
  const auto turned = [](const CameraPose& a, const CameraPose& b) {
    const auto between = a.inverse() * b;
    return std::acos(
        std::clamp((between.rotation[0] + between.rotation[4] + between.rotation[8] - 1) / 2, -1.0, 1.0));
  };
  const auto share = [](const CameraPose& a, const CameraPose& b, const CameraPose& c) {
    return norm(b.translation_m - a.translation_m) / norm(c.translation_m - a.translation_m);
  };
  ASSERT_EQ(motion.poses.size(), truth.poses.size());
  for (std::size_t i = 1; i + 1 < motion.poses.size(); ++i) {
    ASSERT_TRUE(motion.poses[i]) << i;
    EXPECT_NEAR(turned(*motion.poses[0], *motion.poses[i]), turned(truth.poses[0], truth.poses[i]),
                tolerance);
    EXPECT_NEAR(share(*motion.poses.front(), *motion.poses[i], *motion.poses.back()),
                share(truth.poses.front(), truth.poses[i], truth.poses.back()), tolerance);
  }
}

TEST(CameraMotion, IsExactForExactTracks) {
  const SeenScene truth = seen_from_arc(0.6, false, 0.0);
  const auto motion =
      motion_from_tracks(truth.tracks, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {});
  ASSERT_TRUE(motion);
  EXPECT_LT(motion->reprojection_rms_px, 1e-3);
  EXPECT_EQ(motion->points.size(), 200U);
  expect_same_path(*motion, truth, 1e-4);
}

TEST(CameraMotion, ToleratesNoiseAndWrongTracks) {
  SeenScene truth = seen_from_arc(0.6, false, 0.3);
  for (std::size_t i = 0; i < truth.tracks.size(); i += 10)
    for (std::size_t k = 0; k < truth.tracks[i].places.size(); ++k)
      truth.tracks[i].places[k] = {3.0 * static_cast<double>(k) + static_cast<double>(i), 200};
  const auto motion =
      motion_from_tracks(truth.tracks, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {});
  ASSERT_TRUE(motion);
  EXPECT_LT(motion->reprojection_rms_px, 0.5);
  expect_same_path(*motion, truth, 0.005);
}

TEST(CameraMotion, FindsAnUnknownFocalLength) {
  const SeenScene truth = seen_from_arc(0.8, false, 0.1);
  Pinhole wrong = kCamera;
  wrong.fx = wrong.fy = 620;
  const auto motion =
      motion_from_tracks(truth.tracks, consecutive_numbers(kMotionFrames), {wrong, false}, {}, {});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->camera.fx, 500, 5);
  expect_same_path(*motion, truth, 0.01);
}

// A camera on an arc whose direction shakes by a few thousandths of a radian.
CameraPose shaking_pose(double time) {
  const double angle = 0.6 * time / (kMotionFrames - 1);
  CameraPose pose = pose_at(angle + 0.003 * std::sin(0.7 * time) + 0.003 * std::cos(0.31 * time), false);
  pose.translation_m = pose_at(angle, false).translation_m;
  pose.translation_m.y += 0.002 * std::sin(0.5 * time);
  return pose;
}

// The same, each place at the time when its row or column is read.
SeenScene seen_by_rolling_shutter(const Readout& readout, double noise_px) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-0.25, 0.25);
  std::normal_distribution<double> noise(0.0, noise_px);
  SeenScene out;
  for (int k = 0; k < kMotionFrames; ++k) out.poses.push_back(shaking_pose(k));
  for (int p = 0; p < 200; ++p) {
    const Vec3 point{place(random), place(random), place(random)};
    PointTrack track;
    for (int k = 0; k < kMotionFrames; ++k) {
      ImagePoint seen = seen_from(shaking_pose(k), point);
      for (int i = 0; i < 10; ++i) {
        const ImagePoint at = reading_place(seen, kCamera.width, kCamera.height);
        seen = seen_from(shaking_pose(k + readout.rows * at.y + readout.columns * at.x), point);
      }
      track.places.push_back({seen.x + noise(random), seen.y + noise(random)});
    }
    out.tracks.push_back(track);
  }
  return out;
}

TEST(CameraMotion, FindsARollingShutter) {
  for (const Readout readout : {Readout{0.6, 0}, Readout{-0.4, 0}, Readout{0, 0.5}}) {
    const SeenScene truth = seen_by_rolling_shutter(readout, 0.05);
    const auto motion =
        motion_from_tracks(truth.tracks, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {});
    ASSERT_TRUE(motion);
    EXPECT_NEAR(motion->readout.rows, readout.rows, 0.03);
    EXPECT_NEAR(motion->readout.columns, readout.columns, 0.03);
    expect_same_path(*motion, truth, 0.001);
  }
}

TEST(CameraMotion, FindsNoRollingShutterWhereThereIsNone) {
  const SeenScene truth = seen_by_rolling_shutter({}, 0.2);
  const auto motion =
      motion_from_tracks(truth.tracks, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {});
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->readout, Readout{});
}

TEST(CameraMotion, ReportsACameraThatOnlyRotates) {
  const SeenScene truth = seen_from_arc(0.3, true, 0.1);
  const auto motion =
      motion_from_tracks(truth.tracks, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {});
  ASSERT_FALSE(motion);
  EXPECT_EQ(motion.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(motion.error().message, HasSubstr("the camera only turned"));
}

TEST(CameraMotion, FailsWithoutTracksAndWithoutMovement) {
  EXPECT_FALSE(motion_from_tracks({}, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {}));
  const SeenScene still = seen_from_arc(0.0, false, 0.1);
  EXPECT_FALSE(motion_from_tracks(still.tracks, consecutive_numbers(kMotionFrames), {kCamera, true}, {}, {}));
}

}  // namespace
}  // namespace palpable::vision
