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

/// Sets columns [from, to) of rows 9 and 10, counted in the first map, to a depth of 1.9 in map k.
void put_patch(std::vector<PosedDepthMap>& maps, int k, int from, int to) {
  // 0.02 to the side moves it by 1.05 pixels.
  const int moved = static_cast<int>(std::lround(1.05 * k));
  for (const int y : {9, 10})
    for (int x = from - moved; x < to - moved; ++x)
      maps[static_cast<std::size_t>(k)].depth.depth_m(x, y) = 1.9F;
}

// As beside a nearer surface, which neighbouring maps continue into the strip that it hides from others.
TEST(DepthConsistency, RemovesWhatManyMapsSeePast) {
  for (const int agreeing : {3, 7}) {
    auto maps = wall_from(9);
    for (int k = 0; k < agreeing; ++k) put_patch(maps, k, 18, 24);
    const auto out = consistent_depth(maps, {}, {});
    ASSERT_TRUE(out);
    const float found = (*out)[0].depth.depth_m(21, 10);
    // 2 agree and 6 see past it; 6 agree and 2 see past it.
    if (agreeing == 3)
      EXPECT_TRUE(std::isnan(found));
    else
      EXPECT_NEAR(found, 1.9, 1e-5);
  }
}

TEST(DepthConsistency, ChecksAgainWithWhatIsLeft) {
  auto maps = wall_from(3);
  put_patch(maps, 0, 15, 21);
  put_patch(maps, 1, 15, 18);
  put_patch(maps, 2, 18, 21);
  // 12 pixels in the first map; the two patches of 6 that agree with it are too small to stay.
  ConsistencyOptions options{.least_agreeing = 1, .most_through = 16, .passes = 1, .least_patch = 0.009};
  const auto once = consistent_depth(maps, options, {});
  ASSERT_TRUE(once);
  EXPECT_NEAR((*once)[0].depth.depth_m(16, 10), 1.9, 1e-5);
  EXPECT_TRUE(std::isnan((*once)[1].depth.depth_m(15, 10)));
  options.passes = 2;
  const auto twice = consistent_depth(maps, options, {});
  ASSERT_TRUE(twice);
  EXPECT_TRUE(std::isnan((*twice)[0].depth.depth_m(16, 10)));
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
