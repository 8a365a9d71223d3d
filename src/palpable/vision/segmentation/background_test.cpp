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
  Raster<Rgb8> picture{240, 180};
  Raster<float> disparity_px{240, 180};
  /// Seen::nothing is the background, of `cups` Seen::ground.
  Raster<Seen> seen{240, 180, Seen::nothing};
};

/// Two cups before a wall with a poster, matched with noise; `near_px` nearer than the wall.
Scene cups(double near_px) {
  Scene scene;
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
      scene.seen(x, y) = cup ? Seen::object : Seen::ground;
      scene.disparity_px(x, y) = static_cast<float>(6.0 + (cup ? near_px : 0.0) + noise(random));
    }
  return scene;
}

/// How the scenes of a seed are arranged.
enum class View {
  /// A table in front of a wall; objects stand on it, some rise above its far edge.
  table_before_wall,
  /// A tilted table that fills the picture: there is no background.
  table_only,
  /// A table seen from straight above: the table is the background.
  from_above
};

/// Colour with grain.
Rgb8 painted(Rgb8 colour, std::mt19937& random) {
  const int g = std::uniform_int_distribution<int>(-8, 8)(random);
  const auto shift = [g](std::uint8_t v) { return static_cast<std::uint8_t>(std::clamp(v + g, 0, 255)); };
  return {shift(colour.r), shift(colour.g), shift(colour.b)};
}

/// Eight objects of very different heights on a table, matched with noise.
Scene objects_on_table(std::uint32_t seed, View view) {
  Scene scene;
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  std::normal_distribution<double> noise(0.0, 0.15);
  const int edge = view == View::table_before_wall ? 60 : 0;
  const double slope = view == View::from_above ? between(-0.002, 0.002) : between(0.08, 0.15);
  const auto table_px = [&](int y) { return 20.0 + slope * (y - edge); };
  const Rgb8 wood{150, 110, 70}, wall{165, 170, 180};
  for (int y = 0; y < 180; ++y)
    for (int x = 0; x < 240; ++x) {
      const bool on_table = y >= edge;
      scene.picture(x, y) = painted(on_table ? wood : wall, random);
      scene.disparity_px(x, y) =
          static_cast<float>((on_table ? table_px(y) : table_px(edge)) + noise(random));
      if (on_table && view != View::from_above) scene.seen(x, y) = Seen::ground;
    }
  for (int k = 0; k < 8; ++k) {
    const int left = 8 + 58 * (k % 4) + static_cast<int>(between(0, 10)),
              width = static_cast<int>(between(24, 40));
    const int foot = (k < 4 ? 105 : 165) + static_cast<int>(between(0, 8));
    const int top = foot - static_cast<int>(between(25, k < 4 ? 75 : 45));
    const double lift_px = view == View::table_before_wall ? 0.0 : between(1.5, 14.0);
    const Rgb8 colour{static_cast<std::uint8_t>(between(40, 220)),
                      static_cast<std::uint8_t>(between(40, 220)),
                      static_cast<std::uint8_t>(between(40, 220))};
    for (int y = top; y < foot; ++y)
      for (int x = left; x < left + width; ++x) {
        const double front_px = table_px(foot) + lift_px;
        scene.picture(x, y) = painted(colour, random);
        scene.disparity_px(x, y) = static_cast<float>(front_px + noise(random));
        scene.seen(x, y) = Seen::object;
      }
  }
  return scene;
}

/// The share of background pixels that were found, and of object pixels that were marked by mistake.
Shares background_shares(const Raster<std::uint8_t>& mask, Raster<Seen> seen) {
  for (Seen& s : seen.values()) s = s == Seen::nothing ? Seen::ground : s == Seen::ground ? Seen::nothing : s;
  return shares_of(mask, seen);
}

TEST(FindBackground, SeparatesObjectsFromTheWallBehindThem) {
  for (const double near_px : {4.0, 12.0}) {
    const Scene scene = cups(near_px);
    const auto background = find_background(scene.picture, scene.disparity_px, nullptr, Work{});
    ASSERT_TRUE(background) << near_px;
    const Shares shares = shares_of(background->mask, scene.seen);
    EXPECT_GT(shares.ground_found, 0.98) << near_px;
    EXPECT_LT(shares.object_lost, 0.02) << near_px;
  }
}

TEST(FindBackground, AssignsUnknownPixelsToTheirRegion) {
  Scene scene = cups(8.0);
  for (int y = 100; y < 110; ++y)
    for (int x = 0; x < 240; ++x) scene.disparity_px(x, y) = std::numeric_limits<float>::quiet_NaN();
  const auto background = find_background(scene.picture, scene.disparity_px, nullptr, Work{});
  ASSERT_TRUE(background);
  const Shares shares = shares_of(background->mask, scene.seen);
  EXPECT_GT(shares.ground_found, 0.95);
  EXPECT_LT(shares.object_lost, 0.02);
}

TEST(FindBackground, FindsNoneIfNothingIsNearer) {
  Scene scene = cups(0.0);
  EXPECT_FALSE(find_background(scene.picture, scene.disparity_px, nullptr, Work{}));
  for (float& d : scene.disparity_px.values()) d = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(find_background(scene.picture, scene.disparity_px, nullptr, Work{}));
}

TEST(FindBackground, KeepsObjectsOfEveryHeightOnTheGroundBeforeAWall) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = objects_on_table(seed, View::table_before_wall);
    const auto ground = find_ground(scene.picture, scene.disparity_px, Work{});
    ASSERT_TRUE(ground) << seed;
    const auto background = find_background(scene.picture, scene.disparity_px, &*ground, Work{});
    ASSERT_TRUE(background) << seed;
    const Shares shares = background_shares(background->mask, scene.seen);
    EXPECT_GT(shares.ground_found, 0.9) << seed;
    EXPECT_LT(shares.object_lost, 0.03) << seed;
  }
}

TEST(FindBackground, FindsNoneIfEverythingIsOnTheGround) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = objects_on_table(seed, View::table_only);
    const auto ground = find_ground(scene.picture, scene.disparity_px, Work{});
    ASSERT_TRUE(ground) << seed;
    const auto background = find_background(scene.picture, scene.disparity_px, &*ground, Work{});
    EXPECT_FALSE(background) << seed << ": " << background->share;
  }
}

TEST(FindBackground, FindsATableSeenFromAboveAndKeepsItsLowestObjects) {
  for (std::uint32_t seed = 1; seed <= 12; ++seed) {
    const Scene scene = objects_on_table(seed, View::from_above);
    const auto background = find_background(scene.picture, scene.disparity_px, nullptr, Work{});
    ASSERT_TRUE(background) << seed;
    EXPECT_EQ(background->by, Background::By::plane);
    const Shares shares = background_shares(background->mask, scene.seen);
    EXPECT_GT(shares.ground_found, 0.97) << seed;
    EXPECT_LT(shares.object_lost, 0.03) << seed;
  }
}

TEST(Lowered, PutsTheMarkedPixelsAtTheLevelOfTheFarthestObject) {
  const Scene scene = cups(8.0);
  const auto background = find_background(scene.picture, scene.disparity_px, nullptr, Work{});
  ASSERT_TRUE(background);
  const DisparityMap out = lowered({scene.disparity_px, {}}, background->mask);
  EXPECT_EQ(out.disparity_px(60, 100), scene.disparity_px(60, 100));
  EXPECT_EQ(out.disparity_px(5, 5), out.disparity_px(200, 50));
  EXPECT_GT(out.disparity_px(5, 5), 9.0F);
}

}  // namespace
}  // namespace palpable::vision
