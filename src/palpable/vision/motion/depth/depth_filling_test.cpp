// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/motion/depth/depth_filling.hpp"

#include <cmath>
#include <initializer_list>
#include <vector>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr Pinhole kWallCamera{100, 100, 15.5, 11.5, 32, 24};

// The wall z = `depth` seen by cameras side by side; each step moves the wall z = 2 by one pixel.
std::vector<PosedDepthMap> wall_of_depth(int cameras, float depth = 2.0F) {
  std::vector<PosedDepthMap> maps;
  for (int k = 0; k < cameras; ++k) {
    PosedDepthMap map{{Raster<float>(32, 24, depth), kWallCamera}, {}};
    map.pose.translation_m = {0.02 * k, 0.0, 0.0};
    maps.push_back(map);
  }
  return maps;
}

TEST(DepthFilling, TakesTheSurfaceThatOtherMapsMeasured) {
  auto maps = wall_of_depth(3);
  maps[1].depth.depth_m(10, 12) = kUnknownDepth;
  const auto out = filled_depth(maps, {}, {});
  ASSERT_TRUE(out);
  EXPECT_NEAR((*out)[1].depth.depth_m(10, 12), 2.0, 1e-5);
  EXPECT_EQ((*out)[0].depth.depth_m, maps[0].depth.depth_m);
}

TEST(DepthFilling, LeavesUnknownWhatNoMapShows) {
  auto maps = wall_of_depth(2);
  // Camera 1 does not see the left border of camera 0.
  maps[0].depth.depth_m(0, 12) = kUnknownDepth;
  const auto out = filled_depth(maps, {}, {});
  ASSERT_TRUE(out);
  EXPECT_TRUE(std::isnan((*out)[0].depth.depth_m(0, 12)));
}

TEST(DepthFilling, TakesTheSurfaceThatMostMapsAgreeOnOfSeveralTheNearest) {
  auto maps = wall_of_depth(1);
  maps[0].depth.depth_m(10, 12) = kUnknownDepth;
  const auto filled_with = [&](std::initializer_list<float> depths) {
    std::vector<PosedDepthMap> all{maps[0]};
    for (const float depth : depths) {
      all.push_back(maps[0]);
      all.back().depth.depth_m(10, 12) = depth;
    }
    const auto out = filled_depth(all, {}, {});
    return out ? (*out)[0].depth.depth_m(10, 12) : 0.0F;
  };
  EXPECT_NEAR(filled_with({1.0F, 2.0F, 2.001F, 1.5F, 1.999F, 1.501F}), 2.0, 0.002);
  EXPECT_NEAR(filled_with({2.0F, 1.5F, 2.001F, 1.501F}), 1.5, 0.002);
}

TEST(DepthFilling, RefusesOptionsOutOfRange) {
  EXPECT_FALSE(filled_depth(wall_of_depth(2), {.tolerance = 0.0}, {}));
}

}  // namespace
}  // namespace palpable::vision
