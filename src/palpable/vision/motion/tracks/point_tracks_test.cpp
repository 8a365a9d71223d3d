// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/point_tracks.hpp"

#include "palpable/core/numbers/quantile.hpp"

#include <cmath>

#include <gmock/gmock.h>

namespace palpable::vision {
namespace {

// A smooth pattern without repetition, defined at all real positions.
double pattern(double x, double y) {
  return 128 + 40 * std::sin(0.31 * x + 0.7 * std::sin(0.11 * y)) +
         40 * std::cos(0.27 * y + 0.9 * std::sin(0.13 * x)) + 20 * std::sin(0.057 * x * (1 + 0.01 * y));
}

// The pattern moved by (dx, dy).
Raster<std::uint8_t> frame_moved(double dx, double dy) {
  Raster<std::uint8_t> out(160, 120);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x)
      out(x, y) = static_cast<std::uint8_t>(std::lround(pattern(x - dx, y - dy)));
  return out;
}

constexpr double kStepX = 1.3, kStepY = -0.6;

std::vector<Raster<std::uint8_t>> moving_frames(int count) {
  std::vector<Raster<std::uint8_t>> out;
  for (int i = 0; i < count; ++i) out.push_back(frame_moved(kStepX * i, kStepY * i));
  return out;
}

TEST(PointTracks, FollowAMovingPattern) {
  const auto frames = moving_frames(25);
  const auto tracks = track_points(frames, {}, {});
  ASSERT_TRUE(tracks);
  ASSERT_GT(tracks->size(), 20U);
  std::vector<double> errors_px;
  for (const PointTrack& track : *tracks)
    for (std::size_t i = 1; i < track.places.size(); ++i)
      errors_px.push_back(
          std::hypot(track.places[i].x - track.places[0].x - kStepX * static_cast<double>(i),
                     track.places[i].y - track.places[0].y - kStepY * static_cast<double>(i)));
  EXPECT_LT(quantile_of(errors_px, 0.5), 0.03);
  // Windows that extend beyond the picture's border contain repeated pixels.
  EXPECT_LT(quantile_of(errors_px, 0.99), 0.5);
}

// The pattern on a surface that turns and comes nearer: after `time` frames, a place of the first frame is at
// centre + (I + time * kChange) * (place - centre).
constexpr double kChange[4] = {0.008, -0.006, 0.004, 0.011}, kCentre[2] = {80, 60};

ImagePoint place_after(int time, ImagePoint first) {
  const double x = first.x - kCentre[0], y = first.y - kCentre[1];
  return {first.x + time * (kChange[0] * x + kChange[1] * y),
          first.y + time * (kChange[2] * x + kChange[3] * y)};
}

Raster<std::uint8_t> frame_turned(int time) {
  const double a = 1 + time * kChange[0], b = time * kChange[1], c = time * kChange[2],
               d = 1 + time * kChange[3];
  const double determinant = a * d - b * c;
  Raster<std::uint8_t> out(160, 120);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const double u = x - kCentre[0], v = y - kCentre[1];
      const double level =
          pattern(kCentre[0] + (d * u - b * v) / determinant, kCentre[1] + (a * v - c * u) / determinant);
      out(x, y) = static_cast<std::uint8_t>(std::lround(level));
    }
  return out;
}

TEST(PointTracks, DoNotDriftOnASurfaceThatTurns) {
  std::vector<Raster<std::uint8_t>> frames;
  for (int time = 0; time < 40; ++time) frames.push_back(frame_turned(time));
  const auto tracks = track_points(frames, {}, {});
  ASSERT_TRUE(tracks);
  std::vector<double> errors_px;
  for (const PointTrack& track : *tracks) {
    if (track.first_frame > 0 || track.places.size() < 30) continue;
    const ImagePoint expected = place_after(29, track.places[0]), found = track.places[29];
    errors_px.push_back(std::hypot(found.x - expected.x, found.y - expected.y));
  }
  ASSERT_GT(errors_px.size(), 10U);
  EXPECT_LT(quantile_of(errors_px, 0.5), 0.05);
}

TEST(PointTracks, EndWhereAPointLeavesThePictureAndBeginWhereNewOnesAppear) {
  const auto frames = moving_frames(40);
  const auto tracks = track_points(frames, {}, {});
  ASSERT_TRUE(tracks);
  bool some_end = false, some_begin = false;
  for (const PointTrack& track : *tracks) {
    some_end |= track.end_frame() < 40;
    some_begin |= track.first_frame > 0;
    for (const ImagePoint& place : track.places) {
      EXPECT_GE(place.x, 0);
      EXPECT_LE(place.x, 159);
    }
  }
  EXPECT_TRUE(some_end);
  EXPECT_TRUE(some_begin);
}

TEST(PointTracks, LoseAnOccludedPoint) {
  auto frames = moving_frames(6);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 80; ++x) frames[5](x, y) = static_cast<std::uint8_t>((7 * x + 13 * y) % 256);
  const auto tracks = track_points(frames, {}, {});
  ASSERT_TRUE(tracks);
  for (const PointTrack& track : *tracks)
    if (track.in_frame(4) && track.in(4).x < 60) {
      EXPECT_FALSE(track.in_frame(5)) << track.in(4).x;
    }
}

TEST(PointTracks, RefuseFramesOfDifferentSizes) {
  std::vector<Raster<std::uint8_t>> frames{frame_moved(0, 0), Raster<std::uint8_t>(10, 10)};
  const auto tracks = track_points(frames, {}, {});
  ASSERT_FALSE(tracks);
  EXPECT_EQ(tracks.error().code, ErrorCode::invalid_input);
}

TEST(PointTracks, StopWhenCancelled) {
  const std::atomic<bool> cancel = true;
  Work work;
  work.cancel = &cancel;
  const auto tracks = track_points(moving_frames(2), {}, work);
  ASSERT_FALSE(tracks);
  EXPECT_EQ(tracks.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace palpable::vision
