// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/multi_view_depth.hpp"
#include "palpable/vision/motion/structure/exact_views.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Pinhole kSmallCamera{100, 100, 15.5, 11.5, 32, 24};

/// The wall z = 2 as cameras see it that stand side by side and look straight at it: its depth is 2 in all.
std::vector<PosedDepthMap> wall_from(int cameras) {
  std::vector<PosedDepthMap> maps;
  for (int k = 0; k < cameras; ++k) {
    PosedDepthMap map;
    map.depth.depth_m = Raster<float>(32, 24, 2.0F);
    map.depth.camera = kSmallCamera;
    // 0.02 to the side moves the wall by one pixel.
    map.pose.translation_m = {0.02 * k, 0.0, 0.0};
    maps.push_back(map);
  }
  return maps;
}

TEST(DepthConsistency, AveragesTheDepthsThatAgree) {
  auto maps = wall_from(3);
  for (std::size_t k = 0; k < 3; ++k)
    for (float& depth : maps[k].depth.depth_m.values()) depth = 2.0F + 0.004F * static_cast<float>(k);
  const auto out = consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2}, {});
  ASSERT_TRUE(out);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR((*out)[k].depth.depth_m(16, 12), 2.004, 1e-5) << k;
}

TEST(DepthConsistency, RemovesADepthThatOthersContradict) {
  auto maps = wall_from(3);
  maps[1].depth.depth_m(16, 12) = 2.1F;
  const auto out = consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2}, {});
  ASSERT_TRUE(out);
  EXPECT_TRUE(std::isnan((*out)[1].depth.depth_m(16, 12)));
  // The same place of the wall is one pixel further to the right in the camera on its left.
  EXPECT_TRUE(std::isnan((*out)[0].depth.depth_m(17, 12)));
  EXPECT_NEAR((*out)[0].depth.depth_m(16, 12), 2.0, 1e-6);
}

// The place of column 1 of the first map is outside the picture of the third.
TEST(DepthConsistency, KeepsWhatOneMapAgreesWithWhereNoneContradicts) {
  auto maps = wall_from(3);
  const auto kept = consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2}, {});
  ASSERT_TRUE(kept);
  EXPECT_NEAR((*kept)[0].depth.depth_m(1, 12), 2.0, 1e-6);
  const auto strict =
      consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2, .least_uncontested = 2}, {});
  ASSERT_TRUE(strict);
  EXPECT_TRUE(std::isnan((*strict)[0].depth.depth_m(1, 12)));
  // The second map agrees and the third contradicts, with a nearer or a farther surface.
  for (const float other : {1.9F, 2.1F}) {
    maps[2].depth.depth_m(8, 12) = other;
    const auto contested = consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2}, {});
    ASSERT_TRUE(contested);
    EXPECT_TRUE(std::isnan((*contested)[0].depth.depth_m(10, 12))) << other;
  }
}

TEST(DepthConsistency, NeedsSoManyMapsThatSeeThePlace) {
  const auto maps = wall_from(3);
  const auto out = consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 2}, {});
  ASSERT_TRUE(out);
  // The left border of the first map is outside the pictures of the others.
  EXPECT_TRUE(std::isnan((*out)[0].depth.depth_m(0, 12)));
  const auto one = consistent_depth(maps, {.tolerance = 0.01, .least_agreeing = 1}, {});
  ASSERT_TRUE(one);
  EXPECT_TRUE(std::isnan((*one)[0].depth.depth_m(0, 12)));
  EXPECT_NEAR((*one)[0].depth.depth_m(1, 12), 2.0, 1e-6);
}

// Four pixels of the same depth in otherwise unknown maps, such as plain surroundings, beside a large wall.
TEST(DepthConsistency, RemovesSmallPatchesThatAgreeByChance) {
  auto maps = wall_from(3);
  for (std::size_t k = 0; k < 3; ++k)
    for (int y = 0; y < 24; ++y)
      for (int x = 0; x < 12; ++x) maps[k].depth.depth_m(x, y) = kUnknownDepth;
  for (std::size_t k = 0; k < 3; ++k)
    for (const int y : {10, 11})
      for (const int x : {6, 7}) maps[k].depth.depth_m(x - static_cast<int>(k), y) = 2.0F;
  const auto with_patch = [&](double share) {
    const auto out = consistent_depth(maps, {.least_patch = share}, {});
    return out && !std::isnan((*out)[0].depth.depth_m(6, 10));
  };
  constexpr double kPixels = 32 * 24;
  EXPECT_TRUE(with_patch(4 / kPixels));
  EXPECT_FALSE(with_patch(5 / kPixels));
  const auto out = consistent_depth(maps, {.least_patch = 5 / kPixels}, {});
  ASSERT_TRUE(out);
  EXPECT_NEAR((*out)[0].depth.depth_m(20, 12), 2.0, 1e-6);
}

}  // namespace
}  // namespace palpable::vision
