// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/rolling_shutter.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 640, kHeight = 480;

std::vector<int> consecutive(int frames) {
  std::vector<int> out(static_cast<std::size_t>(frames));
  std::iota(out.begin(), out.end(), 0);
  return out;
}

/// A point of a shaking, moving camera's pictures at a time in frames.
ImagePoint place_at(double time) {
  return {200 + 6 * time + 3 * std::sin(0.8 * time), 100 - 4 * time + 3 * std::cos(0.6 * time)};
}

/// Where a rolling shutter shows it: at the time when its own row and column are read.
ImagePoint rolled_place(double frame, const Readout& readout) {
  ImagePoint out = place_at(frame);
  for (int i = 0; i < 20; ++i) {
    const ImagePoint at = reading_place(out, kWidth, kHeight);
    out = place_at(frame + readout.rows * at.y + readout.columns * at.x);
  }
  return out;
}

PointTrack track_of(int frames, const Readout& readout) {
  PointTrack out;
  for (int k = 0; k < frames; ++k) out.places.push_back(rolled_place(k, readout));
  return out;
}

TEST(RollingShutter, MovementIsThatOfThePolynomialThroughThePlaces) {
  PointTrack cubic;
  for (int k = 0; k < 7; ++k)
    cubic.places.push_back({1.0 + 2 * k + 3.0 * k * k + 0.5 * k * k * k, 7.0 - k + 0.25 * k * k});
  const auto [velocity, acceleration] = place_motion(cubic, 3, consecutive(7));
  EXPECT_NEAR(velocity.x, 2 + 6 * 3 + 1.5 * 9, 1e-9);
  EXPECT_NEAR(velocity.y, -1 + 0.5 * 3, 1e-9);
  EXPECT_NEAR(acceleration.x, 6 + 3 * 3, 1e-9);
  EXPECT_NEAR(acceleration.y, 0.5, 1e-9);
}

TEST(RollingShutter, MovementCountsTheTimeOfFramesThatAreLeftOut) {
  PointTrack track;
  const std::vector<int> numbers{0, 2, 3, 7, 8};
  for (const int number : numbers) track.places.push_back({5.0 * number, -1.0 * number * number});
  for (int frame = 0; frame < 5; ++frame) {
    const auto [velocity, acceleration] = place_motion(track, frame, numbers);
    EXPECT_NEAR(velocity.x, 5, 1e-9) << frame;
    EXPECT_NEAR(velocity.y, -2.0 * numbers[static_cast<std::size_t>(frame)], 1e-9) << frame;
    EXPECT_NEAR(acceleration.y, -2, 1e-9) << frame;
  }
}

TEST(RollingShutter, APointThatIsSeenOnceDoesNotMove) {
  PointTrack once;
  once.first_frame = 2;
  once.places = {{4, 5}, kNotSeen};
  const auto [velocity, acceleration] = place_motion(once, 2, consecutive(4));
  EXPECT_EQ(velocity, (ImagePoint{0, 0}));
  EXPECT_EQ(acceleration, (ImagePoint{0, 0}));
}

TEST(RollingShutter, IsRemovedFromTracks) {
  constexpr int kFrames = 20;
  for (const Readout readout : {Readout{0.6, 0}, Readout{-0.6, 0}, Readout{0, 0.6}}) {
    const std::vector<PointTrack> seen{track_of(kFrames, readout)};
    const auto moved = without_rolling_shutter(seen, readout, kWidth, kHeight, consecutive(kFrames));
    double before = 0, after = 0;
    for (int k = 2; k + 2 < kFrames; ++k) {
      const ImagePoint truth = place_at(k);
      before = std::max(before, std::hypot(seen[0].in(k).x - truth.x, seen[0].in(k).y - truth.y));
      after = std::max(after, std::hypot(moved[0].in(k).x - truth.x, moved[0].in(k).y - truth.y));
    }
    EXPECT_GT(before, 0.5);
    EXPECT_LT(after, 0.05);
  }
}

}  // namespace
}  // namespace palpable::vision
