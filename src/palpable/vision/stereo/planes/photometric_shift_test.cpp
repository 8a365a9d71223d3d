// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/photometric_shift.hpp"

#include "palpable/vision/stereo/problem/prepare_pictures.hpp"
#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// The disparity at the right picture's pixel (x, y).
double right_truth(const SyntheticScene& scene, int x, int y) {
  if (scene.in_box(x + scene.box_px, y)) return scene.box_px;
  return (scene.ground_px + scene.slope_x * x + scene.slope_y * y) / (1.0 - scene.slope_x);
}

/// The scene's truth rounded to whole pixels without slopes: the terraces of integer matching.
PlaneMap terraces(const SyntheticScene& scene) {
  PlaneMap map(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      map.disparity(x, y) = static_cast<float>(std::round(scene.truth(x, y)));
  return map;
}

Raster<float> seen_from_right(const SyntheticScene& scene) {
  Raster<float> out(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      out(x, y) = static_cast<float>(std::round(right_truth(scene, x, y)));
  return out;
}

PlaneMap shifted_map(const SyntheticScene& scene, const Work& work = {}) {
  const MatchInput input = prepare_pictures(render(scene), work);
  PlaneMap map = terraces(scene);
  refine_photometrically(colour_planes(input.left), input.left_grey, input.right_grey, seen_from_right(scene),
                         {}, map, work);
  return map;
}

TEST(PhotometricShift, TurnsTerracesIntoASlope) {
  const SyntheticScene scene = slanted_scene();
  ASSERT_GT(bad_fraction(scene, terraces(scene).disparity, 0.1, 4), 0.5);
  const PlaneMap map = shifted_map(scene);
  EXPECT_LE(bad_fraction(scene, map.disparity, 0.1, 4), 0.01);
}

TEST(PhotometricShift, ToleratesADifferenceInBrightness) {
  SyntheticScene scene = slanted_scene();
  const MatchInput input = prepare_pictures(render(scene), {});
  Raster<std::uint8_t> brighter = input.right_grey;
  for (std::uint8_t& v : brighter.values()) v = static_cast<std::uint8_t>(std::min(255, v + 20));
  PlaneMap map = terraces(scene);
  refine_photometrically(colour_planes(input.left), input.left_grey, brighter, seen_from_right(scene), {},
                         map, {});
  EXPECT_LE(bad_fraction(scene, map.disparity, 0.25, 4), 0.02);
}

TEST(PhotometricShift, DoesNotChangeAPlainPicture) {
  const SyntheticScene scene;
  const Raster<std::uint8_t> plain(scene.width, scene.height, std::uint8_t{90});
  PlaneMap map = terraces(scene);
  const PlaneMap before = map;
  refine_photometrically({plain, plain, plain}, plain, plain, seen_from_right(scene), {}, map, {});
  for (std::size_t i = 0; i < map.disparity.count(); ++i)
    ASSERT_EQ(map.disparity.values()[i], before.disparity.values()[i]);
}

TEST(PhotometricShift, MovesNothingByMoreThanHalfAPixel) {
  SyntheticScene scene = slanted_scene();
  const MatchInput input = prepare_pictures(render(scene), {});
  PlaneMap map = terraces(scene);
  // All disparities are one pixel too large.
  for (float& d : map.disparity.values()) d += 1.0F;
  const PlaneMap before = map;
  refine_photometrically(colour_planes(input.left), input.left_grey, input.right_grey, seen_from_right(scene),
                         {}, map, {});
  for (std::size_t i = 0; i < map.disparity.count(); ++i)
    ASSERT_LE(std::fabs(map.disparity.values()[i] - before.disparity.values()[i]), 0.5F + 1e-5F);
}

TEST(PhotometricShift, IsIndependentOfTheNumberOfThreads) {
  const SyntheticScene scene = slanted_scene();
  Work two;
  two.threads = 2;
  const PlaneMap a = shifted_map(scene);
  const PlaneMap b = shifted_map(scene, two);
  for (std::size_t i = 0; i < a.disparity.count(); ++i)
    ASSERT_EQ(a.disparity.values()[i], b.disparity.values()[i]);
}

}  // namespace
}  // namespace palpable::vision
