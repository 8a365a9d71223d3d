// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_tracks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

// Photographs taken far apart: neighbours share points, but no three pictures do.
TEST(VideoTracks, AreFollowedIfThreePicturesShareThem) {
  const auto tracks_through = [](int pictures) {
    std::vector<vision::PointTrack> out;
    for (int first = 0; first + pictures <= 12; ++first)
      for (int i = 0; i < 100; ++i)
        out.push_back({first, std::vector<vision::ImagePoint>(static_cast<std::size_t>(pictures))});
    return out;
  };
  EXPECT_FALSE(are_followed(tracks_through(2), 12, {}));
  EXPECT_TRUE(are_followed(tracks_through(3), 12, {}));
  EXPECT_TRUE(are_followed(tracks_through(2), 2, {}));
}

// A smooth random surface of waves, of which a camera sees a part, turned and moved to the side.
class Waves {
 public:
  Waves() {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(0, 6.28), length_px(9, 30);
    for (Wave& wave : waves_) {
      const double direction = angle(random), per_px = 6.28 / length_px(random);
      wave = {per_px * std::cos(direction), per_px * std::sin(direction), angle(random)};
    }
  }
  Raster<std::uint8_t> seen(double moved_px, double turned) const {
    Raster<std::uint8_t> out(200, 160);
    for (int y = 0; y < out.height(); ++y)
      for (int x = 0; x < out.width(); ++x) {
        const double u = x - 100, v = y - 80;
        const double a = std::cos(turned) * u - std::sin(turned) * v + moved_px,
                     b = std::sin(turned) * u + std::cos(turned) * v;
        double sum = 0;
        for (const Wave& w : waves_) sum += std::sin(w.along_x * a + w.along_y * b + w.phase);
        out(x, y) = static_cast<std::uint8_t>(std::clamp(128 + 16 * sum, 0.0, 255.0));
      }
    return out;
  }

 private:
  struct Wave {
    double along_x, along_y, phase;
  };
  std::array<Wave, 40> waves_{};
};

// Tracks that the pictures before and after a gap share.
int count_across(const std::vector<vision::PointTrack>& tracks, int gap) {
  return static_cast<int>(std::count_if(tracks.begin(), tracks.end(), [&](const vision::PointTrack& track) {
    return track.first_frame < gap && track.end_frame() > gap;
  }));
}

TEST(VideoTracks, CrossAJerkOfTheCamera) {
  const Waves waves;
  std::vector<Raster<std::uint8_t>> pictures;
  for (int i = 0; i < 6; ++i) pictures.push_back(waves.seen(2.0 * i, 0.0));
  for (int i = 0; i < 6; ++i) pictures.push_back(waves.seen(30 + 2.0 * i, 0.6));
  VideoRecipe recipe;
  // So many points that the small pictures have enough of them.
  recipe.following.times_least = 1;
  const auto found = tracks_of_video(pictures, recipe, {});
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->are_followed);
  const auto followed = vision::track_points(pictures, recipe.tracks, {});
  ASSERT_TRUE(followed);
  EXPECT_GT(count_across(found->tracks, 6), count_across(*followed, 6) + 24);
  // They are where the surface is.
  int right = 0;
  for (const auto& track : found->tracks) {
    if (!track.in_frame(5) || !track.in_frame(6)) continue;
    const auto a = track.in(5), b = track.in(6);
    const double u = b.x - 100, v = b.y - 80;
    const double x = std::cos(0.6) * u - std::sin(0.6) * v + 30 - 10 + 100,
                 y = std::sin(0.6) * u + std::cos(0.6) * v + 80;
    right += std::hypot(x - a.x, y - a.y) < 2 ? 1 : 0;
  }
  EXPECT_GT(right, 20);
}

}  // namespace
}  // namespace palpable::recipes
