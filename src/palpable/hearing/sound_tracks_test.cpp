// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/hearing/sound_tracks.hpp"

#include <gtest/gtest.h>

namespace palpable::hearing {
namespace {

HeardWindow window_at(double begin_s, std::optional<double> azimuth_deg, double confidence = 0.5) {
  HeardWindow window;
  window.begin_s = begin_s;
  window.end_s = begin_s + 0.5;
  window.confidence = confidence;
  window.shared_power = 1.0;
  window.other_power = 0.1;
  if (azimuth_deg) window.direction = direction_at(*azimuth_deg, 40.0);
  return window;
}

TEST(SoundTracks, JoinWindowsOfOneDirectionAndSayEachSoundOnce) {
  SoundTracks tracks(ArrayShape::level);
  EXPECT_TRUE(tracks.take(window_at(0.0, 28.0)));
  EXPECT_FALSE(tracks.take(window_at(0.25, 34.0)));
  EXPECT_TRUE(tracks.take(window_at(0.5, -120.0))) << "another one meanwhile";
  EXPECT_FALSE(tracks.take(window_at(0.75, 31.0)));
  EXPECT_FALSE(tracks.take(window_at(2.0, std::nullopt)));
  const auto ended = tracks.take_ended(false);
  ASSERT_EQ(ended.size(), 2U);
  EXPECT_NEAR(ended[1].bearing.azimuth_deg, 31.0, 0.1);
  EXPECT_FALSE(ended[1].bearing.elevation_deg);
  EXPECT_DOUBLE_EQ(ended[1].begin_s, 0.0);
  EXPECT_DOUBLE_EQ(ended[1].end_s, 1.25);
  EXPECT_NEAR(ended[1].snr_db, 10.0, 1e-9);
  EXPECT_TRUE(tracks.take(window_at(2.5, 31.0))) << "again, after a pause";
  EXPECT_EQ(tracks.take_ended(true).size(), 1U);
}

}  // namespace
}  // namespace palpable::hearing
