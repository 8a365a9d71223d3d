// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/recursive_motion.hpp"

#include "palpable/vision/motion/structure/exact_views.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

using testing::HasSubstr;

constexpr Pinhole kVideoCamera{500, 500, 319.5, 239.5, 640, 480};
constexpr int kVideoFrames = 40;
constexpr unsigned kSeeds = 3;

// Fewer points than usual, which takes less time.
FilterMotionOptions quick_options() {
  FilterMotionOptions out;
  out.most_points = 80;
  return out;
}

struct SyntheticVideo {
  std::vector<CameraPose> poses;
  std::vector<PointTrack> tracks;
};

struct SyntheticVideoOptions {
  unsigned seed = 1;
  double noise_px = 0.3;
  double arc = 0.7;
  // Frames in which a point is followed.
  int track_frames = kVideoFrames;
  int points = 300;
  bool turns_only = false;
};

// A camera on an arc round a box of points, 1 away and looking at it, shaking a little.
SyntheticVideo synthetic_video(const SyntheticVideoOptions& options) {
  std::mt19937 random(options.seed);
  std::uniform_real_distribution<double> place(-0.3, 0.3), share(0, 1);
  std::normal_distribution<double> noise(0, 1);
  SyntheticVideo out;
  for (int i = 0; i < kVideoFrames; ++i) {
    const double angle = options.arc * i / (kVideoFrames - 1) + 0.002 * noise(random);
    const double c = std::cos(angle), s = std::sin(angle);
    CameraPose pose;
    pose.rotation = {c, 0, -s, 0, 1, 0, s, 0, c};
    pose.translation_m =
        options.turns_only ? Vec3{0, 0, -1} : Vec3{s + 0.002 * noise(random), 0.002 * noise(random), -c};
    out.poses.push_back(pose);
  }
  for (int p = 0; p < options.points; ++p) {
    const Point<WorldFrame> point{{place(random), place(random), place(random)}};
    // Tracks that began before the video or end after it are cut.
    const int first =
        options.track_frames < kVideoFrames
            ? static_cast<int>(std::floor(share(random) * (kVideoFrames + options.track_frames))) -
                  options.track_frames
            : 0;
    PointTrack track;
    track.first_frame = std::max(0, first);
    const int end = std::min(kVideoFrames, first + options.track_frames);
    for (int i = track.first_frame; i < end; ++i) {
      const Vec3 v = (out.poses[static_cast<std::size_t>(i)].inverse() * point).v;
      track.places.push_back(
          {kVideoCamera.fx * v.x / v.z + kVideoCamera.cx + options.noise_px * noise(random),
           kVideoCamera.fy * v.y / v.z + kVideoCamera.cy + options.noise_px * noise(random)});
    }
    if (track.places.size() < 2) continue;
    out.tracks.push_back(track);
  }
  return out;
}

struct PathErrors {
  // RMS of positions, percent of the path; the largest angle between rotations.
  double position_percent = 0.0, most_rotation_deg = 0.0;
};

// After the similarity that makes the first cameras equal and fits the scale of the positions seen from
// there.
PathErrors errors_of(const CameraMotion& motion, const SyntheticVideo& truth) {
  const auto first = truth.poses.front().inverse();
  double product = 0, square = 0, path = 0, sum = 0;
  std::vector<Vec3> found, wanted;
  PathErrors out;
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    const auto relative = first * truth.poses[i];
    const auto got = motion.poses.front()->inverse() * *motion.poses[i];
    found.push_back(got.translation_m), wanted.push_back(relative.translation_m);
    product += dot(found.back(), wanted.back()), square += squared_norm(found.back());
    if (i > 0) path += norm(wanted[i] - wanted[i - 1]);
    double difference = 0;
    for (std::size_t k = 0; k < 9; ++k) difference += std::pow(relative.rotation[k] - got.rotation[k], 2);
    out.most_rotation_deg =
        std::max(out.most_rotation_deg, 2 * std::asin(std::sqrt(difference / 8)) * 180 / 3.14159265358979);
  }
  for (std::size_t i = 0; i < found.size(); ++i) sum += squared_norm(product / square * found[i] - wanted[i]);
  out.position_percent = 100 * std::sqrt(sum / static_cast<double>(found.size())) / path;
  return out;
}

bool has_all_poses(const CameraMotion& motion) {
  return std::all_of(motion.poses.begin(), motion.poses.end(), [](const auto& p) { return p.has_value(); });
}

TEST(RecursiveMotion, ConvergesToTheTruthForExactTracks) {
  const auto video = synthetic_video({.noise_px = 0.0});
  FilterMotionOptions options = quick_options();
  options.noise_px = 0.05;
  const auto motion = motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, options, {});
  ASSERT_TRUE(motion);
  ASSERT_TRUE(has_all_poses(*motion));
  const auto errors = errors_of(*motion, video);
  EXPECT_LT(errors.position_percent, 0.02);
  EXPECT_LT(errors.most_rotation_deg, 0.02);
  EXPECT_LT(motion->reprojection_rms_px, 0.05);
}

TEST(RecursiveMotion, FollowsTheCameraWhileTracksComeAndGo) {
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto video = synthetic_video({.seed = seed, .track_frames = 16, .points = 600});
    const auto motion =
        motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, quick_options(), {});
    ASSERT_TRUE(motion) << seed;
    ASSERT_TRUE(has_all_poses(*motion)) << seed;
    const auto errors = errors_of(*motion, video);
    // Nothing is seen at the beginning and at the end: errors accumulate.
    EXPECT_LT(errors.position_percent, 2) << seed;
    EXPECT_LT(errors.most_rotation_deg, 3.0) << seed;
    EXPECT_LT(motion->reprojection_rms_px, 0.7) << seed;
    EXPECT_GT(motion->points.size(), video.tracks.size() * 8 / 10) << seed;
  }
}

TEST(RecursiveMotion, IsNearlyAsAccurateAsTheBatchWherePointsStayInView) {
  double filter = 0, batch = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto video = synthetic_video({.seed = seed});
    const auto filtered =
        motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, quick_options(), {});
    const auto adjusted =
        motion_from_tracks(video.tracks, consecutive_numbers(kVideoFrames), {kVideoCamera, true}, {}, {});
    ASSERT_TRUE(filtered && adjusted) << seed;
    filter += errors_of(*filtered, video).position_percent / kSeeds;
    batch += errors_of(*adjusted, video).position_percent / kSeeds;
  }
  RecordProperty("filter_position_percent", std::to_string(filter));
  RecordProperty("batch_position_percent", std::to_string(batch));
  EXPECT_LT(filter, 0.5);
  EXPECT_LT(batch, filter);
}

// The batch's keyframes must be near enough for tracks that are shorter than the video.
TEST(RecursiveMotion, IsLessAccurateThanTheBatchWhileTracksComeAndGo) {
  double filter = 0, batch = 0;
  for (unsigned seed = 1; seed <= kSeeds; ++seed) {
    const auto video = synthetic_video({.seed = seed, .track_frames = 16, .points = 600});
    const auto filtered =
        motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, quick_options(), {});
    const auto adjusted =
        motion_from_tracks(video.tracks, consecutive_numbers(kVideoFrames), {kVideoCamera, true}, {}, {});
    ASSERT_TRUE(filtered && adjusted) << seed;
    ASSERT_TRUE(has_all_poses(*filtered) && has_all_poses(*adjusted)) << seed;
    filter += errors_of(*filtered, video).position_percent / kSeeds;
    batch += errors_of(*adjusted, video).position_percent / kSeeds;
  }
  RecordProperty("filter_position_percent", std::to_string(filter));
  RecordProperty("batch_position_percent", std::to_string(batch));
  EXPECT_LT(batch, 0.3);
  EXPECT_LT(batch, filter / 2);
}

TEST(RecursiveMotion, NeedsOnePassToFollowTheCamera) {
  FilterMotionOptions options = quick_options();
  options.passes = 1;
  const auto video = synthetic_video({.track_frames = 20, .points = 500});
  const auto motion = motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, options, {});
  ASSERT_TRUE(motion);
  ASSERT_TRUE(has_all_poses(*motion));
  EXPECT_LT(errors_of(*motion, video).position_percent, 2);
}

TEST(RecursiveMotion, LeavesOutWrongTracks) {
  auto video = synthetic_video({});
  for (std::size_t i = 0; i < video.tracks.size(); i += 10)
    for (std::size_t k = 0; k < video.tracks[i].places.size(); ++k)
      video.tracks[i].places[k] = {static_cast<double>(i), 100 + 6.0 * static_cast<double>(k)};
  const auto motion = motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, quick_options(), {});
  ASSERT_TRUE(motion);
  ASSERT_TRUE(has_all_poses(*motion));
  EXPECT_LT(errors_of(*motion, video).position_percent, 0.5);
  for (const StructurePoint& point : motion->points) EXPECT_NE(point.track % 10, 0U);
}

TEST(RecursiveMotion, GivesNoPoseToAFrameThatFitsNothing) {
  auto video = synthetic_video({});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> anywhere(0, 640);
  for (PointTrack& track : video.tracks) track.places[20] = {anywhere(random), anywhere(random)};
  const auto motion = motion_by_filter(video.tracks, kVideoFrames, {kVideoCamera, true}, quick_options(), {});
  ASSERT_TRUE(motion);
  for (std::size_t i = 0; i < motion->poses.size(); ++i)
    EXPECT_EQ(motion->poses[i].has_value(), i != 20) << i;
}

TEST(RecursiveMotion, FindsAnUnknownFocalLength) {
  const auto video = synthetic_video({.noise_px = 0.1, .arc = 0.9});
  Pinhole wrong = kVideoCamera;
  wrong.fx = wrong.fy = 560;
  const auto motion = motion_by_filter(video.tracks, kVideoFrames, {wrong, false}, quick_options(), {});
  ASSERT_TRUE(motion);
  EXPECT_NEAR(motion->camera.fx, 500, 10);
}

TEST(RecursiveMotion, FailsAsTheBatchDoes) {
  const auto turning = synthetic_video({.turns_only = true});
  const auto refused = motion_by_filter(turning.tracks, kVideoFrames, {kVideoCamera, true}, {}, {});
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::invalid_input);
  EXPECT_THAT(refused.error().message, HasSubstr("slowly around"));
  EXPECT_FALSE(motion_by_filter({}, kVideoFrames, {kVideoCamera, true}, {}, {}));
}

TEST(RecursiveMotion, RefusesOptionsOutOfRange) {
  FilterMotionOptions options;
  options.passes = 3;
  EXPECT_EQ(motion_by_filter({}, kVideoFrames, {kVideoCamera, true}, options, {}).error().code,
            ErrorCode::usage);
  options = {};
  options.most_points = 10;
  EXPECT_EQ(motion_by_filter({}, kVideoFrames, {kVideoCamera, true}, options, {}).error().code,
            ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::vision
