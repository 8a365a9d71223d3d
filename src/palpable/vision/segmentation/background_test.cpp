// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/background.hpp"

#include "palpable/vision/segmentation/ground_scene.hpp"

#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

struct Scene {
  Raster<Rgb8> picture;
  Raster<float> disparity_px;
  Raster<Seen> seen;
};

/// Two cups before a wall with a poster, matched with noise; `near_px` nearer than the wall.
Scene cups(double near_px) {
  Scene scene{Raster<Rgb8>(240, 180), Raster<float>(240, 180), Raster<Seen>(240, 180, Seen::ground)};
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 0.3);
  std::uniform_int_distribution<int> grain(-10, 10);
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 240; ++x) {
      const bool poster = x > 150 && x < 220 && y > 20 && y < 90;
      const bool cup = (x > 30 && x < 90 && y > 70 && y < 150) || (x > 120 && x < 160 && y > 100 && y < 150);
      const Rgb8 colour = cup ? Rgb8{180, 60, 50} : poster ? Rgb8{60, 120, 70} : Rgb8{150, 160, 175};
      const int g = grain(random);
      const auto shift = [g](std::uint8_t v) { return static_cast<std::uint8_t>(v + g); };
      scene.picture(x, y) = {shift(colour.r), shift(colour.g), shift(colour.b)};
      if (cup) scene.seen(x, y) = Seen::object;
      scene.disparity_px(x, y) = static_cast<float>(6.0 + (cup ? near_px : 0.0) + noise(random));
    }
  return scene;
}

TEST(FindBackground, PartsThingsFromTheWallBehindThem) {
  for (const double near_px : {4.0, 12.0}) {
    const Scene scene = cups(near_px);
    const auto background = find_background(scene.picture, scene.disparity_px, Work{});
    ASSERT_TRUE(background) << near_px;
    const Shares shares = shares_of(background->mask, scene.seen);
    EXPECT_GT(shares.ground_found, 0.98) << near_px;
    EXPECT_LT(shares.object_lost, 0.02) << near_px;
    EXPECT_GE(background->removed, 1);
    EXPECT_LT(background->removed, background->regions);
  }
}

TEST(FindBackground, GivesUnknownPixelsToTheRegionTheyLieIn) {
  Scene scene = cups(8.0);
  for (int y = 100; y < 110; ++y)
    for (int x = 0; x < 240; ++x) scene.disparity_px(x, y) = std::numeric_limits<float>::quiet_NaN();
  const auto background = find_background(scene.picture, scene.disparity_px, Work{});
  ASSERT_TRUE(background);
  const Shares shares = shares_of(background->mask, scene.seen);
  EXPECT_GT(shares.ground_found, 0.95);
  EXPECT_LT(shares.object_lost, 0.02);
}

TEST(FindBackground, FindsNoneWhereNothingStandsOut) {
  Scene scene = cups(0.0);
  EXPECT_FALSE(find_background(scene.picture, scene.disparity_px, Work{}));
  for (float& d : scene.disparity_px.values()) d = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(find_background(scene.picture, scene.disparity_px, Work{}));
}

TEST(Lowered, PutsWhatGoesAtTheLevelOfTheFarthestThing) {
  const Scene scene = cups(8.0);
  const auto background = find_background(scene.picture, scene.disparity_px, Work{});
  ASSERT_TRUE(background);
  const DisparityMap out = lowered({scene.disparity_px, {}}, background->mask);
  EXPECT_EQ(out.disparity_px(60, 100), scene.disparity_px(60, 100));
  EXPECT_EQ(out.disparity_px(5, 5), out.disparity_px(200, 50));
  EXPECT_GT(out.disparity_px(5, 5), 9.0F);
}

}  // namespace
}  // namespace palpable::vision
