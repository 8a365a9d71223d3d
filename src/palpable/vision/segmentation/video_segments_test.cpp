// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/video_segments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kFrameWidth = 120, kFrameHeight = 80;

struct Box {
  int left = 0, top = 0, right = 0, bottom = 0;
  Rgb8 colour;
  float height = 0.0F;
  bool holds(int x, int y) const { return x >= left && x < right && y >= top && y < bottom; }
};

struct Labelled {
  SegmentFrame frame;
  // 0 is the ground, then the boxes from 1.
  Raster<int> labels;
};

// Boxes on a green ground, with noise; later ones cover earlier ones.
Labelled drawn(const std::vector<Box>& boxes, unsigned seed, bool with_height = false) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> noise(-6, 6);
  const auto noisy = [&](int value) {
    return static_cast<std::uint8_t>(std::clamp(value + noise(random), 0, 255));
  };
  Labelled out{{Raster<Rgb8>(kFrameWidth, kFrameHeight), {}, {}}, Raster<int>(kFrameWidth, kFrameHeight, 0)};
  if (with_height) out.frame.height = Raster<float>(kFrameWidth, kFrameHeight, 0.0F);
  for (int y = 0; y < kFrameHeight; ++y)
    for (int x = 0; x < kFrameWidth; ++x) {
      Rgb8 colour{60, 130, 70};
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].holds(x, y)) continue;
        colour = boxes[i].colour;
        out.labels(x, y) = static_cast<int>(i) + 1;
        if (with_height) out.frame.height(x, y) = boxes[i].height;
      }
      out.frame.picture(x, y) = {noisy(colour.r), noisy(colour.g), noisy(colour.b)};
    }
  return out;
}

// The identity that most pixels of a label have, and the share of the label's pixels that have it.
struct Match {
  int identity = -1;
  double share = 0.0;
};
Match match_of(const FrameSegments& found, const Raster<int>& labels, int label) {
  std::map<int, int> counts;
  int all = 0;
  for (std::size_t i = 0; i < labels.count(); ++i)
    if (labels.values()[i] == label) ++counts[found.of_pixel.values()[i]], ++all;
  Match out;
  for (const auto& [identity, count] : counts)
    if (count > out.share * all) out = {identity, static_cast<double>(count) / all};
  return out;
}

const Rgb8 kRed{190, 60, 50}, kBlue{50, 70, 180}, kYellow{210, 190, 60};

TEST(VideoSegments, FindsBoxesOfDifferentColours) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const auto picture =
        drawn({{10, 10, 50, 50, kRed}, {70, 30, 110, 70, kBlue}, {60, 4, 84, 24, kYellow}}, seed);
    const auto found = VideoSegmenter({}).add(picture.frame);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->segments.size(), 4U) << seed;
    std::set<int> identities;
    for (int label = 0; label < 4; ++label) {
      const Match match = match_of(*found, picture.labels, label);
      EXPECT_GT(match.share, 0.95) << seed << ' ' << label;
      identities.insert(match.identity);
    }
    EXPECT_EQ(identities.size(), 4U) << seed;
  }
}

TEST(VideoSegments, SeparatesBoxesOfOneColourThatDoNotTouch) {
  const auto picture = drawn({{8, 20, 40, 60, kRed}, {70, 20, 110, 60, kRed}}, 1);
  const auto found = VideoSegmenter({}).add(picture.frame);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->segments.size(), 3U);
  EXPECT_NE(match_of(*found, picture.labels, 1).identity, match_of(*found, picture.labels, 2).identity);
}

TEST(VideoSegments, SeparatesBoxesOfOneColourThatTouchByTheirHeights) {
  const std::vector<Box> boxes{{20, 20, 60, 60, kRed, 1.0F}, {60, 20, 100, 60, kRed, 2.5F}};
  const auto flat = drawn(boxes, 1), tall = drawn(boxes, 1, true);
  const auto by_colour = VideoSegmenter({}).add(flat.frame);
  ASSERT_TRUE(by_colour);
  EXPECT_EQ(match_of(*by_colour, flat.labels, 1).identity, match_of(*by_colour, flat.labels, 2).identity);
  const auto by_height = VideoSegmenter({}).add(tall.frame);
  ASSERT_TRUE(by_height);
  EXPECT_NE(match_of(*by_height, tall.labels, 1).identity, match_of(*by_height, tall.labels, 2).identity);
  EXPECT_GT(match_of(*by_height, tall.labels, 1).share, 0.95);
  EXPECT_GT(match_of(*by_height, tall.labels, 2).share, 0.95);
}

TEST(VideoSegments, FillsUnknownHeightsFromTheNearestOnes) {
  auto picture = drawn({{20, 20, 60, 60, kRed, 1.0F}, {60, 20, 100, 60, kRed, 2.5F}}, 1, true);
  for (int y = 0; y < kFrameHeight; ++y)
    for (int x = 0; x < kFrameWidth; ++x)
      if ((x + y) % 3 != 0) picture.frame.height(x, y) = std::numeric_limits<float>::quiet_NaN();
  const auto found = VideoSegmenter({}).add(picture.frame);
  ASSERT_TRUE(found);
  EXPECT_NE(match_of(*found, picture.labels, 1).identity, match_of(*found, picture.labels, 2).identity);
}

TEST(VideoSegments, SeparatesWhatMovesDifferently) {
  auto picture = drawn({}, 1);
  for (int y = 2; y < kFrameHeight; y += 4)
    for (int x = 2; x < kFrameWidth; x += 4) {
      const bool left = x < 50;
      picture.frame.motion.push_back(
          {static_cast<double>(x), static_cast<double>(y), left ? 12.0 : 0.0, 0.0});
      for (int dy = -2; dy < 2; ++dy)
        for (int dx = -2; dx < 2; ++dx) picture.labels(x + dx, y + dy) = left ? 1 : 0;
    }
  const auto found = VideoSegmenter({}).add(picture.frame);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->segments.size(), 2U);
  EXPECT_GT(match_of(*found, picture.labels, 1).share, 0.95);
}

TEST(VideoSegments, AbsorbsFragments) {
  std::vector<Box> boxes{{20, 10, 100, 70, kRed}};
  for (int i = 0; i < 6; ++i) boxes.push_back({25 + 12 * i, 30, 28 + 12 * i, 33, kYellow});
  const auto picture = drawn(boxes, 1);
  const auto found = VideoSegmenter({}).add(picture.frame);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->segments.size(), 2U);
}

TEST(VideoSegments, KeepsIdentitiesWhileObjectsMoveAppearAndDisappear) {
  VideoSegmenter segmenter({});
  std::set<int> of_red, of_blue, of_ground, of_yellow;
  for (int frame = 0; frame < 12; ++frame) {
    std::vector<Box> boxes{{5 + 4 * frame, 10, 35 + 4 * frame, 40, kRed}, {70, 45, 105, 75, kBlue}};
    if (frame >= 6) boxes.push_back({5, 50, 35, 75, kYellow});
    const auto picture = drawn(boxes, static_cast<unsigned>(frame));
    const auto found = segmenter.add(picture.frame);
    ASSERT_TRUE(found);
    EXPECT_EQ(found->segments.size(), boxes.size() + 1) << frame;
    of_ground.insert(match_of(*found, picture.labels, 0).identity);
    of_red.insert(match_of(*found, picture.labels, 1).identity);
    of_blue.insert(match_of(*found, picture.labels, 2).identity);
    if (frame >= 6) of_yellow.insert(match_of(*found, picture.labels, 3).identity);
  }
  EXPECT_EQ(of_ground.size(), 1U);
  EXPECT_EQ(of_red.size(), 1U);
  EXPECT_EQ(of_blue.size(), 1U);
  ASSERT_EQ(of_yellow.size(), 1U);
  for (const auto* other : {&of_ground, &of_red, &of_blue}) EXPECT_NE(*of_yellow.begin(), *other->begin());
}

TEST(VideoSegments, CountsEveryPixelOnceInConnectedSegments) {
  const auto picture = drawn({{10, 10, 50, 50, kRed}, {70, 30, 110, 70, kBlue}}, 3);
  const auto found = VideoSegmenter({}).add(picture.frame);
  ASSERT_TRUE(found);
  std::map<int, int> counts;
  for (const int identity : found->of_pixel.values()) ++counts[identity];
  ASSERT_EQ(counts.size(), found->segments.size());
  for (const VideoSegment& segment : found->segments) EXPECT_EQ(segment.pixels, counts[segment.identity]);
}

TEST(VideoSegments, RefusesFramesThatDoNotFit) {
  VideoSegmenter segmenter({});
  EXPECT_FALSE(segmenter.add({}));
  const auto picture = drawn({}, 1);
  ASSERT_TRUE(segmenter.add(picture.frame));
  EXPECT_FALSE(segmenter.add({Raster<Rgb8>(10, 10), {}, {}}));
  EXPECT_FALSE(segmenter.add({picture.frame.picture, {}, Raster<float>(10, 10)}));
  VideoSegmentOptions wrong;
  wrong.cell_px = 0;
  const auto refused = VideoSegmenter(wrong).add(picture.frame);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::vision
