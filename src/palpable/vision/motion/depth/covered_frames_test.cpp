// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/covered_frames.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kWidth = 128, kHeight = 96;
constexpr Pinhole kCoveredCamera{100, 100, 63.5, 47.5, kWidth, kHeight};

// A wall z = 2, green on the left and blue on the right, in five frames of cameras side by side; each step
// moves it by two pixels, and each frame is a little brighter than the last one.
struct WallVideo {
  std::vector<FrameDepth> maps;
  std::vector<Raster<Rgb8>> pictures;

  WallVideo() {
    for (int k = 0; k < 5; ++k) {
      const DepthMap wall{Raster<float>(kWidth, kHeight, 2.0F), kCoveredCamera};
      FrameDepth map{k, {wall, {}}, wall};
      map.map.pose.translation_m = {0.04 * k, 0.0, 0.0};
      maps.push_back(map);
      Raster<Rgb8> picture(kWidth, kHeight);
      const int gain = 100 + 5 * k;
      const auto level = [&](int value) { return static_cast<std::uint8_t>(value * gain / 100); };
      for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
          picture(x, y) =
              x + 2 * k < kWidth / 2 ? Rgb8{20, level(120), level(60)} : Rgb8{20, level(60), level(120)};
      pictures.push_back(picture);
    }
  }

  // Something of that colour and 32 x 24 pixels in front of frame 2, whose depth no map measured.
  void cover(Rgb8 colour) {
    for (int y = 32; y < 56; ++y)
      for (int x = 16; x < 48; ++x) {
        pictures[2](x, y) = colour;
        maps[2].map.depth.depth_m(x, y) = kUnknownDepth;
      }
  }
  std::vector<double> shares() const {
    std::vector<const Raster<Rgb8>*> views;
    for (const auto& picture : pictures) views.push_back(&picture);
    return covered_shares(maps, views, {});
  }
};

TEST(CoveredFrames, HaveTheAreaOfWhatIsInFrontOfThem) {
  WallVideo video;
  video.cover({200, 150, 130});
  const auto shares = video.shares();
  ASSERT_EQ(shares.size(), 5U);
  EXPECT_NEAR(shares[2], 32.0 * 24 / (kWidth * kHeight), 1e-9);
  for (const std::size_t other : {0U, 1U, 3U, 4U}) EXPECT_EQ(shares[other], 0.0);
}

TEST(CoveredFrames, AreNotThoseWhereOnlyDepthIsMissing) {
  WallVideo video;
  const Rgb8 wall = video.pictures[2](20, 40);
  video.cover(wall);
  EXPECT_EQ(std::ranges::max(video.shares()), 0.0);
}

TEST(CoveredFrames, AreNotJudgedWhereOthersDoNotShowTheSurface) {
  WallVideo video;
  video.cover({200, 150, 130});
  for (const std::size_t other : {0U, 1U, 3U, 4U})
    for (float& depth : video.maps[other].map.depth.depth_m.values()) depth = 3.0F;
  EXPECT_EQ(std::ranges::max(video.shares()), 0.0);
}

}  // namespace
}  // namespace palpable::vision
