// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/structure/keyframes.hpp"

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

using testing::ElementsAre;

constexpr int kWidth_px = 100;

BatchMotionOptions three_pixels() {
  BatchMotionOptions options;
  options.keyframe_step = 0.025;
  options.keyframe_kept = 0.5;
  options.least_points = 6;
  return options;
}

// `count` points that move right by one pixel a frame, in frames first … end - 1.
std::vector<PointTrack> moving(int count, int first, int end) {
  PointTrack track{first, {}};
  for (int frame = first; frame < end; ++frame) track.places.push_back({10.0 + frame, 20.0});
  return std::vector<PointTrack>(static_cast<std::size_t>(count), track);
}

TEST(Keyframes, FollowWhenThePointsHaveMovedFarEnough) {
  EXPECT_THAT(choose_keyframes(moving(40, 0, 11), 11, kWidth_px, three_pixels()),
              ElementsAre(0, 3, 6, 9, 10));
}

TEST(Keyframes, FollowEarlierWhereTooFewPointsAreLeft) {
  auto options = three_pixels();
  options.keyframe_step = 0.5;
  options.keyframe_kept = 0.0;
  EXPECT_THAT(choose_keyframes(moving(40, 0, 5), 7, kWidth_px, options), ElementsAre(0, 5, 6));
}

TEST(Keyframes, HaveFramesBetweenThemWhereMostPointsAreReplaced) {
  // All points of frames 0 to 2 are lost by frame 3, but for the 24 that a step needs.
  auto tracks = moving(60, 0, 3);
  for (const auto& track : moving(24, 0, 7)) tracks.push_back(track);
  EXPECT_THAT(choose_keyframes(tracks, 7, kWidth_px, three_pixels()), ElementsAre(0, 1, 2, 3, 6));
}

}  // namespace
}  // namespace palpable::vision
