// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/segmentation/ground.hpp"

#include "palpable/vision/segmentation/ground_scene.hpp"
#include "palpable/vision/segmentation/regions.hpp"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

struct Room {
  Raster<Rgb8> picture;
  Raster<float> disparity_px;
  Raster<Seen> seen;
};

constexpr DisparityPlane kFloor{0.01, 0.09, -4.0};

/// A textured floor that rises to 20 px, a wall behind it and three boxes on it, with noise of `noise_px`.
Room room(double noise_px, double unknown_share) {
  Room scene{Raster<Rgb8>(320, 240), Raster<float>(320, 240), Raster<Seen>(320, 240)};
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0.0, noise_px);
  std::uniform_int_distribution<int> grain(-12, 12);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  struct BoxInRoom {
    int left, right, top, foot;
  };
  const BoxInRoom boxes[] = {{40, 90, 90, 170}, {140, 200, 60, 130}, {230, 300, 150, 225}};
  for (int y = 0; y < 240; ++y) {
    for (int x = 0; x < 320; ++x) {
      double d = std::max(kFloor.at(x, y), 3.0);
      Seen seen = kFloor.at(x, y) > 3.0 ? Seen::ground : Seen::nothing;
      Rgb8 colour = seen == Seen::ground ? Rgb8{120, 90, 60} : Rgb8{170, 180, 200};
      for (const BoxInRoom& box : boxes) {
        if (x < box.left || x >= box.right || y < box.top || y >= box.foot) continue;
        d = kFloor.at(x, box.foot);
        seen = Seen::object;
        colour = {60, 110, 140};
      }
      const int g = grain(random);
      const auto shift = [g](std::uint8_t v) { return static_cast<std::uint8_t>(v + g); };
      scene.picture(x, y) = {shift(colour.r), shift(colour.g), shift(colour.b)};
      scene.seen(x, y) = seen;
      scene.disparity_px(x, y) = chance(random) < unknown_share ? std::numeric_limits<float>::quiet_NaN()
                                                                : static_cast<float>(d + noise(random));
    }
  }
  return scene;
}

/// At least 98 % of the floor is found, and at most a share of the objects is marked by mistake.
void expect_found(const Room& scene, double most_lost) {
  const auto ground = find_ground(scene.picture, scene.disparity_px, Work{});
  ASSERT_TRUE(ground);
  const Shares shares = shares_of(ground->mask, scene.seen);
  EXPECT_GT(shares.ground_found, 0.98);
  EXPECT_LT(shares.object_lost, most_lost);
}

TEST(FindGround, FindsTheFloorOfARoomWithoutTheObjectsOnIt) {
  for (const double noise_px : {0.02, 0.15, 0.3}) {
    const Room scene = room(noise_px, 0.05);
    const auto ground = find_ground(scene.picture, scene.disparity_px, Work{});
    ASSERT_TRUE(ground) << noise_px;
    const StereoRig rig{{300.0, 300.0, 159.5, 119.5, 320, 240}, 0.1, 0.0};
    EXPECT_LT(degrees_between(normal_of(ground->plane, rig).v, normal_of(kFloor, rig).v), 1.0) << noise_px;
    const Shares shares = shares_of(ground->mask, scene.seen);
    EXPECT_GT(shares.ground_found, 0.98) << noise_px;
    EXPECT_LT(shares.object_lost, 0.02) << noise_px;
  }
}

TEST(FindGround, FindsNoneBeforeAWall) {
  Room scene = room(0.1, 0.0);
  for (float& d : scene.disparity_px.values()) d = 7.0F;
  EXPECT_FALSE(find_ground(scene.picture, scene.disparity_px, Work{}));
  for (float& d : scene.disparity_px.values()) d = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(find_ground(scene.picture, scene.disparity_px, Work{}));
}

TEST(FindGround, DoesNotMistakeASteppedWallForGround) {
  // The wall recedes a little downwards, as for a camera that looks down.
  Room scene = room(0.0, 0.0);
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      scene.disparity_px(x, y) = std::round(static_cast<float>(55.0 - 0.0075 * x - 0.0035 * y));
  EXPECT_FALSE(find_ground(scene.picture, scene.disparity_px, Work{}));
}

TEST(FindGround, ExcludesObjectsOfTheGroundsColour) {
  Room scene = room(0.05, 0.0);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> grain(-12, 12);
  for (std::size_t i = 0; i < scene.seen.count(); ++i) {
    if (scene.seen.values()[i] == Seen::nothing) continue;
    const auto level = [g = grain(random)](int v) { return static_cast<std::uint8_t>(v + g); };
    scene.picture.values()[i] = {level(120), level(90), level(60)};
  }
  expect_found(scene, 0.05);
}

TEST(FindGround, FollowsThePicturesEdgesWhereDisparityIsFattened) {
  constexpr int kSpread_px = 6;
  const Room exact = room(0.05, 0.0);
  Room scene = exact;
  for (int y = 0; y < 240; ++y)
    for (int x = 0; x < 320; ++x)
      for (int u = std::max(0, x - kSpread_px); u <= std::min(319, x + kSpread_px); ++u)
        if (exact.seen(u, y) == Seen::object)
          scene.disparity_px(x, y) = std::max(scene.disparity_px(x, y), exact.disparity_px(u, y));
  expect_found(scene, 0.02);
}

TEST(NormalOf, PointsUpFromALevelFloor) {
  // A camera 1 m above a level floor that looks horizontally: Z = fy h / (y - cy), so d = B (y - cy) / h.
  const StereoRig rig{{500.0, 500.0, 320.0, 240.0, 640, 480}, 0.1, 0.0};
  const Vec3 normal = normal_of({0.0, 0.1, -24.0}, rig).v;
  EXPECT_NEAR(normal.x, 0.0, 1e-12);
  EXPECT_NEAR(normal.y, -1.0, 1e-12);
  EXPECT_NEAR(normal.z, 0.0, 1e-12);
}

TEST(TreatGround, FlattensTheGroundAndKeepsTheObjects) {
  const Room scene = room(0.05, 0.0);
  const auto ground = find_ground(scene.picture, scene.disparity_px, Work{});
  ASSERT_TRUE(ground);
  const DisparityMap flat = treat_ground({scene.disparity_px, {}}, *ground, GroundTreatment::flatten);
  EXPECT_EQ(flat.disparity_px(10, 230), 0.0F);
  EXPECT_NEAR(flat.disparity_px(260, 160), kFloor.at(260, 225) - kFloor.at(260, 160), 0.4);
  const DisparityMap removed = treat_ground({scene.disparity_px, {}}, *ground, GroundTreatment::remove);
  EXPECT_LT(removed.disparity_px(10, 230), 4.0F);
  EXPECT_EQ(removed.disparity_px(260, 160), scene.disparity_px(260, 160));
  const DisparityMap kept = treat_ground({scene.disparity_px, {}}, *ground, GroundTreatment::keep);
  EXPECT_EQ(kept.disparity_px, scene.disparity_px);
}

TEST(MergeRegions, SeparatesDifferentColoursAndJoinsNoisyOnes) {
  const Room scene = room(0.1, 0.0);
  const Regions regions = merge_regions(scene.picture);
  EXPECT_LT(regions.count(), 40);
  EXPECT_NE(regions.of_pixel(60, 120), regions.of_pixel(10, 230));
  EXPECT_NE(regions.of_pixel(10, 5), regions.of_pixel(10, 230));
  EXPECT_EQ(regions.of_pixel(10, 230), regions.of_pixel(110, 235));
}

}  // namespace
}  // namespace palpable::vision
