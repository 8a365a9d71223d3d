// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/tracks/usable_frames.hpp"

#include <algorithm>
#include <random>
#include <vector>

#include <gmock/gmock.h>
#include <opencv2/imgproc.hpp>

namespace palpable::vision {
namespace {

using testing::ElementsAre;

// Random patches, moved by `shift` and blurred along x.
Raster<std::uint8_t> patches(int shift, int blur) {
  Raster<std::uint8_t> out(160, 120);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      std::minstd_rand random(static_cast<unsigned>(((x + shift) / 6) * 131 + (y / 6) * 17 + 5));
      random.discard(3);
      out(x, y) = static_cast<std::uint8_t>(random() % 256U);
    }
  cv::Mat view(out.height(), out.width(), CV_8U, out.data());
  if (blur > 0) cv::blur(view, view, {blur, blur});
  return out;
}

TEST(UsableFrames, LeavesOutBlurredFramesAndCopies) {
  std::vector<Raster<std::uint8_t>> frames;
  for (int i = 0; i < 9; ++i) frames.push_back(patches(2 * i, i == 4 ? 15 : 0));
  frames.push_back(frames.back());
  const auto chosen = usable_frames(frames, {}, {});
  ASSERT_TRUE(chosen);
  EXPECT_THAT(chosen->kept, ElementsAre(0, 1, 2, 3, 5, 6, 7, 8));
  EXPECT_EQ(chosen->blurred, 1);
  EXPECT_EQ(chosen->copies, 1);
}

TEST(UsableFrames, KeepsAVideoThatIsBlurredThroughout) {
  std::vector<Raster<std::uint8_t>> frames;
  for (int i = 0; i < 6; ++i) frames.push_back(patches(2 * i, 9));
  const auto chosen = usable_frames(frames, {}, {});
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->kept.size(), frames.size());
}

TEST(UsableFrames, CountsBlurredFramesAmongBlurredOnes) {
  constexpr int kFrames = 30;
  std::vector<Raster<std::uint8_t>> frames;
  for (int i = 0; i < kFrames; ++i) frames.push_back(patches(2 * i, i % 2 == 1 ? 15 : 0));
  const auto chosen = usable_frames(frames, {}, {});
  ASSERT_TRUE(chosen);
  EXPECT_EQ(chosen->blurred + chosen->soft, kFrames / 2);
  EXPECT_GT(chosen->soft, 0);
}

// Steps of grey levels, up and down, that are `width` pixels wide.
Raster<std::uint8_t> ramps(int width, bool across_columns) {
  Raster<std::uint8_t> out(96, 96);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      const int at = (across_columns ? x : y) % 32;
      const int risen = std::clamp(at - 4, 0, width) - std::clamp(at - 20, 0, width);
      out(x, y) = static_cast<std::uint8_t>(30 + 180 * risen / width);
    }
  return out;
}

TEST(EdgeWidth, IsThatOfAStepInEitherDirection) {
  for (const int width : {1, 2, 4, 6}) {
    EXPECT_NEAR(edge_width_px(ramps(width, true)), width, 0.1);
    EXPECT_NEAR(edge_width_px(ramps(width, false)), width, 0.1);
  }
  EXPECT_EQ(edge_width_px(Raster<std::uint8_t>(40, 40, 90)), 1.0);
  EXPECT_EQ(edge_width_px(Raster<std::uint8_t>(4, 4, 90)), 1.0);
}

TEST(EdgeWidth, TellsAVideoThatIsBlurredThroughout) {
  const auto width_of = [](int blur) {
    std::vector<Raster<std::uint8_t>> frames;
    for (int i = 0; i < 6; ++i) frames.push_back(patches(2 * i, blur));
    return usable_frames(frames, {}, {})->edge_width_px;
  };
  EXPECT_LT(width_of(0), 1.5);
  EXPECT_GT(width_of(9), 4.0);
}

TEST(UsableFrames, RefusesOptionsOutOfRange) {
  const auto chosen = usable_frames({}, {.least_sharpness = 2.0}, {});
  ASSERT_FALSE(chosen);
  EXPECT_EQ(chosen.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::vision
