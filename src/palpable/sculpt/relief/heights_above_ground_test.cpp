// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/heights_above_ground.hpp"

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

/// A plate tilted by 6 mm over its depth, with a block of 2 mm on it.
models::Relief tilted_block() {
  Raster<float> z(120, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const bool block = x > 30 && x < 60 && y > 20 && y < 60;
      z(x, y) = 0.006F * static_cast<float>(y) / 89.0F + (block ? 0.002F : 0.0F);
    }
  return *models::Relief::from_samples(std::move(z), 0.001);
}

TEST(HeightsAboveGround, AreThoseOfABlockOnATiltedPlate) {
  const auto heights = heights_above_ground(tilted_block(), Work{});
  ASSERT_TRUE(heights);
  EXPECT_NEAR((*heights)(45, 40), 0.002, 0.0001);
  EXPECT_NEAR((*heights)(5, 5), 0.0, 0.0001);
  EXPECT_NEAR((*heights)(100, 85), 0.0, 0.0001);
}

TEST(HeightsAboveGround, FollowAGroundThatTheMappingOfDepthHasBent) {
  // As tilted_block(), but the plate bends by 0.5 mm towards its corners.
  Raster<float> z(120, 90);
  const auto is_block = [](int x, int y) { return x > 30 && x < 60 && y > 20 && y < 60; };
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      const double u = (x - 60.0) / 60.0, v = (y - 45.0) / 45.0;
      z(x, y) =
          static_cast<float>(0.003 * (1.0 + v) + 0.00025 * (u * u + v * v) + (is_block(x, y) ? 0.002 : 0.0));
    }
  const auto heights = heights_above_ground(*models::Relief::from_samples(std::move(z), 0.001), Work{});
  ASSERT_TRUE(heights);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x)
      ASSERT_NEAR((*heights)(x, y), is_block(x, y) ? 0.002 : 0.0, 0.0001) << x << " " << y;
}

TEST(HeightsAboveGround, AreNoneWithoutAPlane) {
  Raster<float> z(60, 60);
  for (int y = 0; y < 60; ++y)
    for (int x = 0; x < 60; ++x)
      z(x, y) = 0.01F * static_cast<float>((x - 30) * (x - 30) + (y - 30) * (y - 30)) / 1800.0F;
  EXPECT_FALSE(heights_above_ground(*models::Relief::from_samples(std::move(z), 0.001), Work{}));
}

}  // namespace
}  // namespace palpable::sculpt
