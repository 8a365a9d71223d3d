// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/video/video_scale.hpp"

#include <gmock/gmock.h>

namespace palpable::recipes {
namespace {

// A wall at 2 units, seen along z; unknown at the left of column 20.
vision::FrameDepth wall() {
  vision::FrameDepth out;
  out.frame = 7;
  out.map.depth.camera = Pinhole{100, 100, 49.5, 39.5, 100, 80};
  out.map.depth.depth_m = Raster<float>(100, 80, 2.0F);
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 20; ++x) out.map.depth.depth_m(x, y) = kUnknownDepth;
  return out;
}

TEST(ScaleFromLength, IsTheRatioOfTheLengthToTheDistanceOnTheSurface) {
  const std::vector<vision::FrameDepth> maps{wall()};
  // 40 px at depth 2 with a focal length of 100 px are 0.8 units.
  const auto scale = scale_from_length({0.12, 3, {30, 40}, {70, 40}}, 7, maps, {});
  ASSERT_TRUE(scale.metres_per_unit);
  EXPECT_NEAR(*scale.metres_per_unit, 0.12 / 0.8, 1e-6);
}

TEST(ScaleFromLength, TakesTheNearestKnownDepth) {
  const std::vector<vision::FrameDepth> maps{wall()};
  const auto scale = scale_from_length({0.12, 3, {15, 40}, {70, 40}}, 7, maps, {});
  ASSERT_TRUE(scale.metres_per_unit);
  EXPECT_NEAR(*scale.metres_per_unit, 0.12 / 1.1, 1e-6);
}

TEST(ScaleFromLength, SaysWhyThereIsNone) {
  const std::vector<vision::FrameDepth> maps{wall()};
  const auto unknown = scale_from_length({0.12, 3, {2, 40}, {70, 40}}, 7, maps, {});
  EXPECT_FALSE(unknown.metres_per_unit);
  ASSERT_EQ(unknown.notes.size(), 1U);
  EXPECT_THAT(unknown.notes[0].sentence, testing::HasSubstr("at 2,40 of frame 3"));
  const auto elsewhere = scale_from_length({0.12, 3, {30, 40}, {70, 40}}, 8, maps, {});
  EXPECT_FALSE(elsewhere.metres_per_unit);
  EXPECT_THAT(elsewhere.notes[0].sentence, testing::HasSubstr("frame 3"));
}

}  // namespace
}  // namespace palpable::recipes
