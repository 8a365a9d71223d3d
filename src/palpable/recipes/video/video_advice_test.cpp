// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_advice.hpp"

#include <gmock/gmock.h>

namespace palpable::recipes {
namespace {

using testing::HasSubstr;

VideoFigures good_video() {
  VideoFigures out;
  out.frames = out.posed = out.tried = 100;
  out.followed_points = 700, out.brightness = 0.5, out.known_depth = 0.9;
  out.left_seen = out.right_seen = out.front_seen = out.back_seen = true;
  return out;
}

std::string only_advice(const VideoFigures& figures) {
  const auto advice = advice_on(figures, {});
  EXPECT_EQ(advice.size(), 1U);
  return advice.empty() ? std::string() : advice.front().sentence;
}

TEST(VideoAdvice, IsEmptyForAGoodVideo) { EXPECT_TRUE(advice_on(good_video(), {}).empty()); }

TEST(VideoAdvice, NamesEachFault) {
  VideoFigures video = good_video();
  video.blurred = 15, video.soft = 25;
  EXPECT_THAT(only_advice(video), HasSubstr("film more slowly"));
  video = good_video(), video.edge_width_px = 6;
  EXPECT_THAT(only_advice(video), HasSubstr("All pictures are blurred"));
  video = good_video(), video.frames = video.tried = video.posed = 3;
  EXPECT_THAT(only_advice(video), HasSubstr("only 3 pictures"));
  video = good_video(), video.posed = 60;
  EXPECT_THAT(only_advice(video), HasSubstr("60 of 100"));
  video = good_video(), video.followed_points = 40;
  EXPECT_THAT(only_advice(video), HasSubstr("newspaper"));
  video = good_video(), video.brightness = 0.05;
  EXPECT_THAT(only_advice(video), HasSubstr("more light"));
  video = good_video(), video.known_depth = 0.2;
  EXPECT_THAT(only_advice(video), HasSubstr("20 %"));
  video = good_video(), video.moving_points = 0.2;
  EXPECT_THAT(only_advice(video), HasSubstr("such as a hand"));
  video = good_video(), video.covered = 0.1;
  EXPECT_THAT(only_advice(video), HasSubstr("such as a hand"));
  video = good_video(), video.cuts = {50};
  EXPECT_THAT(only_advice(video), HasSubstr("cut before frame 50"));
}

TEST(VideoAdvice, NamesTheSidesThatWereNeverSeen) {
  VideoFigures video = good_video();
  video.left_seen = false;
  EXPECT_THAT(only_advice(video), HasSubstr("The left side was never seen"));
  video.back_seen = false;
  EXPECT_THAT(only_advice(video), HasSubstr("The left side and the back were never seen"));
}

TEST(SeenSides, FollowFromThePositionsOfTheCamera) {
  VideoFigures video;
  const std::vector<Vec3> positions{{0, -1, 1}, {0.6, -1, 1}};
  add_seen_sides(positions, {0, 0, 0}, {}, video);
  EXPECT_TRUE(video.front_seen);
  EXPECT_TRUE(video.right_seen);
  EXPECT_FALSE(video.left_seen);
  EXPECT_FALSE(video.back_seen);
}

vision::PointTrack track(int first, int frames) {
  return {first, std::vector<vision::ImagePoint>(static_cast<std::size_t>(frames), {1, 2})};
}

TEST(CutsInAVideo, AreWhereHardlyAnyPointStays) {
  std::vector<vision::PointTrack> tracks(200, track(0, 10));
  tracks.insert(tracks.end(), 150, track(10, 10));
  tracks.insert(tracks.end(), 3, track(0, 20));
  std::vector<std::optional<vision::CameraPose>> poses(20);
  std::fill_n(poses.begin(), 10, vision::CameraPose());
  EXPECT_EQ(cuts_in(tracks, poses, {}), std::vector<int>{10});
  // Photographs whose points are matched with others than their neighbours, too.
  poses[12] = vision::CameraPose();
  EXPECT_TRUE(cuts_in(tracks, poses, {}).empty());
  poses[12].reset();
  tracks.insert(tracks.end(), 80, track(5, 10));
  EXPECT_TRUE(cuts_in(tracks, poses, {}).empty());
}

}  // namespace
}  // namespace palpable::recipes
