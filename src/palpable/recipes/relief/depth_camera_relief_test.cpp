// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/recipes/relief/relief_recipe.hpp"

#include <cmath>
#include <memory>
#include <random>

#include <gtest/gtest.h>

namespace palpable::recipes {
namespace {

constexpr int kRoomWidth = 240, kRoomHeight = 180;

/// A door at 2 m, half open before a wall at 3 m, as a depth camera reads it.
DepthInput noisy_door() {
  std::mt19937 random(2);
  std::normal_distribution<float> normal;
  DepthMap map;
  map.depth_m = Raster<float>(kRoomWidth, kRoomHeight);
  for (int y = 0; y < kRoomHeight; ++y)
    for (int x = 0; x < kRoomWidth; ++x) {
      const float z = x < kRoomWidth / 2 ? 2.0F + 0.002F * static_cast<float>(x) : 3.0F;
      map.depth_m(x, y) = z + vision::DepthNoise().deviation_m(z) * normal(random);
    }
  return {std::move(map), {}};
}

/// The share of the door that is steeper than 0.8.
double steep_share(const MadeScene& made) {
  const auto& relief = *std::get<std::shared_ptr<const models::Relief>>(made.scene.model);
  const auto& height_m = relief.samples_m();
  int steep = 0, all = 0;
  for (int y = 10; y < kRoomHeight - 10; ++y)
    for (int x = 10; x < kRoomWidth / 2 - 10; ++x, ++all) {
      const auto by_x = static_cast<double>(height_m(x + 1, y) - height_m(x - 1, y)),
                 by_y = static_cast<double>(height_m(x, y + 1) - height_m(x, y - 1));
      if (std::hypot(by_x, by_y) > 0.8 * 2.0 * relief.pixel_m()) ++steep;
    }
  return static_cast<double>(steep) / all;
}

TEST(DepthCameraRelief, HasFlatDoors) {
  ReliefRecipe recipe;
  const auto made = relief_from_depth(noisy_door(), recipe, Work{});
  ASSERT_TRUE(made);
  EXPECT_LT(steep_share(*made), 0.01);
  ASSERT_FALSE(made->notes.empty());
  EXPECT_NE(made->notes.front().sentence.find("noise"), std::string::npos);
  recipe.depth_camera.most_level = 0.0;
  const auto rough = relief_from_depth(noisy_door(), recipe, Work{});
  ASSERT_TRUE(rough);
  EXPECT_GT(steep_share(*rough), 0.1);
}

}  // namespace
}  // namespace palpable::recipes
