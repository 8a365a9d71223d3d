// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/false_islands.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kIslandsWidth = 120;
constexpr int kIslandsHeight = 60;
constexpr float kGround_px = 4.0F;
constexpr float kIsland_px = 12.0F;

bool on_island(int x, int y) { return x >= 60 && x < 70 && y >= 20 && y < 25; }

/// All pixels match at the ground's disparity except those with `hidden`; the island also matches at its own.
template <class Hidden>
CostVolume costs(const Hidden& hidden, bool island_on_ground) {
  CostVolume out(kIslandsWidth, kIslandsHeight, 20);
  for (int y = 0; y < kIslandsHeight; ++y)
    for (int x = 0; x < kIslandsWidth; ++x)
      for (int d = 0; d < 20; ++d) {
        const bool ground = d == 4 && !hidden(x, y) && (island_on_ground || !on_island(x, y));
        const bool island = d == 12 && on_island(x, y);
        out.at(x, y)[d] = static_cast<std::uint16_t>(ground || island ? 0 : kCostUnit);
      }
  return out;
}

PlaneMap map_with_island() {
  PlaneMap map(kIslandsWidth, kIslandsHeight);
  for (int y = 0; y < kIslandsHeight; ++y)
    for (int x = 0; x < kIslandsWidth; ++x) map.disparity(x, y) = on_island(x, y) ? kIsland_px : kGround_px;
  return map;
}

TEST(FalseIslands, ThatWouldOccludeVisiblePixelsAreRemoved) {
  PlaneMap map = map_with_island();
  PlaneMap start = map;
  remove_false_islands(costs([](int, int) { return false; }, true), {}, {}, map, start);
  for (const float d : map.disparity.values()) ASSERT_EQ(d, kGround_px);
  for (const float d : start.disparity.values()) ASSERT_EQ(d, kGround_px);
}

TEST(FalseIslands, ThatOccludeTheGroundAreKept) {
  PlaneMap map = map_with_island();
  PlaneMap start = map;
  const Raster<float> before = map.disparity;
  const auto hidden = [](int x, int y) { return !on_island(x, y) && on_island(x + 8, y); };
  remove_false_islands(costs(hidden, false), {}, {}, map, start);
  EXPECT_EQ(map.disparity, before);
  EXPECT_EQ(start.disparity, before);
}

}  // namespace
}  // namespace palpable::vision
