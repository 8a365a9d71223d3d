// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video_advice.hpp"

#include <gmock/gmock.h>

namespace palpable::recipes {
namespace {

using testing::HasSubstr;

VideoFigures good_film() {
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

TEST(VideoAdvice, IsEmptyForAGoodFilm) { EXPECT_TRUE(advice_on(good_film(), {}).empty()); }

TEST(VideoAdvice, NamesEachFault) {
  VideoFigures film = good_film();
  film.blurred = 40;
  EXPECT_THAT(only_advice(film), HasSubstr("film more slowly"));
  film = good_film(), film.frames = film.tried = film.posed = 3;
  EXPECT_THAT(only_advice(film), HasSubstr("only 3 pictures"));
  film = good_film(), film.posed = 60;
  EXPECT_THAT(only_advice(film), HasSubstr("60 of 100"));
  film = good_film(), film.followed_points = 40;
  EXPECT_THAT(only_advice(film), HasSubstr("newspaper"));
  film = good_film(), film.brightness = 0.05;
  EXPECT_THAT(only_advice(film), HasSubstr("more light"));
  film = good_film(), film.known_depth = 0.2;
  EXPECT_THAT(only_advice(film), HasSubstr("20 %"));
  film = good_film(), film.cuts = {50};
  EXPECT_THAT(only_advice(film), HasSubstr("cut before frame 50"));
}

TEST(VideoAdvice, NamesTheSidesThatWereNeverSeen) {
  VideoFigures film = good_film();
  film.left_seen = false;
  EXPECT_THAT(only_advice(film), HasSubstr("The left side was never seen"));
  film.back_seen = false;
  EXPECT_THAT(only_advice(film), HasSubstr("The left side and the back were never seen"));
}

TEST(SeenSides, FollowFromThePositionsOfTheCamera) {
  VideoFigures film;
  const std::vector<Vec3> positions{{0, -1, 1}, {0.6, -1, 1}};
  add_seen_sides(positions, {0, 0, 0}, {}, film);
  EXPECT_TRUE(film.front_seen);
  EXPECT_TRUE(film.right_seen);
  EXPECT_FALSE(film.left_seen);
  EXPECT_FALSE(film.back_seen);
}

vision::PointTrack track(int first, int frames) {
  return {first, std::vector<vision::ImagePoint>(static_cast<std::size_t>(frames), {1, 2})};
}

TEST(CutsInAFilm, AreWhereHardlyAnyPointStays) {
  std::vector<vision::PointTrack> tracks(200, track(0, 10));
  tracks.insert(tracks.end(), 150, track(10, 10));
  tracks.insert(tracks.end(), 3, track(0, 20));
  EXPECT_EQ(cuts_in(tracks, 20, {}), std::vector<int>{10});
  tracks.insert(tracks.end(), 80, track(5, 10));
  EXPECT_TRUE(cuts_in(tracks, 20, {}).empty());
}

}  // namespace
}  // namespace palpable::recipes
