// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_from_depth.hpp"

#include "palpable/sculpt/relief/holes.hpp"

#include <atomic>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

DepthMap hill(int width, int height) {
  DepthMap map;
  map.depth_m = Raster<float>(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      map.depth_m(x, y) = static_cast<float>(
          2.0 - 0.5 * std::exp(-(std::pow(x - width / 2.0, 2) + std::pow(y - height / 2.0, 2)) / 800.0));
  return map;
}

TEST(ReliefFromDepth, RaisesNearPartsAndKeepsTheAspectRatio) {
  const auto relief = relief_from_depth(hill(200, 100), {}, {});
  ASSERT_TRUE(relief);
  EXPECT_NEAR(relief->size_x_m(), 0.100, 1e-9);
  EXPECT_NEAR(relief->size_y_m(), 0.050, 1e-9);
  EXPECT_EQ(relief->lowest_m(), 0.0);
  EXPECT_NEAR(relief->highest_m(), 0.015, 1e-6);
  EXPECT_GT(relief->sample(0, 0).z_m, relief->sample(0.04, 0.02).z_m);
}

TEST(ReliefFromDepth, HeightIsLinearInDisparityIfRequested) {
  DisparityMap map{Raster<float>(100, 50), StereoRig{Pinhole{100, 100, 50, 25, 100, 50}, 0.1, 0.0}};
  for (int y = 0; y < 50; ++y)
    for (int x = 0; x < 100; ++x) map.disparity_px(x, y) = static_cast<float>(10 + x);
  ReliefOptions options;
  options.detail = DetailOperator::linear;
  options.steepest_slope = 100.0;
  options.height_of = HeightOf::disparity;
  const auto by_disparity = relief_from_disparity(map, options, {});
  options.height_of = HeightOf::depth;
  const auto by_depth = relief_from_disparity(map, options, {});
  ASSERT_TRUE(by_disparity && by_depth);
  // Of the window, which leaves out half a percent at each end.
  for (int x = 5; x < 95; ++x)
    EXPECT_NEAR(by_disparity->samples_m()(x, 20), 0.015 * (x - 0.0) / 99.0, 2e-4) << x;
  EXPECT_GT(by_depth->samples_m()(30, 20), by_disparity->samples_m()(30, 20) + 0.002F);
}

TEST(ReliefFromDepth, EngravesNearParts) {
  ReliefOptions options;
  options.sense = Sense::engrave;
  const auto relief = relief_from_depth(hill(200, 100), options, {});
  ASSERT_TRUE(relief);
  EXPECT_EQ(relief->lowest_m(), 0.0);
  EXPECT_LT(relief->sample(0, 0).z_m, relief->sample(0.04, 0.02).z_m);
}

TEST(ReliefFromDepth, ObeysTheGivenSize) {
  ReliefOptions options;
  options.size_m = Vec3{0.2, 0.05, 0.03};
  const auto relief = relief_from_depth(hill(200, 100), options, {});
  ASSERT_TRUE(relief);
  EXPECT_NEAR(relief->size_x_m(), 0.100, 1e-9);
  EXPECT_NEAR(relief->size_y_m(), 0.050, 1e-9);
  EXPECT_NEAR(relief->highest_m(), 0.030, 1e-6);
}

TEST(ReliefFromDepth, SmoothsAwayFeaturesNarrowerThanTheDevicesAccuracy) {
  DepthMap waves;
  waves.depth_m = Raster<float>(160, 120);
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 160; ++x) waves.depth_m(x, y) = static_cast<float>(2.0 - x / 160.0 + 0.05 * (x % 2));
  const auto height_of_waves = [&](double smooth_m) {
    ReliefOptions options;
    options.detail = DetailOperator::linear;
    options.smooth_m = smooth_m;
    const auto relief = relief_from_depth(waves, options, {});
    EXPECT_TRUE(relief);
    const auto& z = relief->samples_m();
    return std::abs(z(81, 60) - 0.5F * (z(80, 60) + z(82, 60)));
  };
  EXPECT_GT(height_of_waves(0.0), 2e-4F);
  EXPECT_LT(height_of_waves(0.002), 2e-6F);
  ReliefOptions options;
  options.smooth_m = 0.02;
  EXPECT_EQ(relief_from_depth(waves, options, {}).error().code, ErrorCode::usage);
}

TEST(ReliefFromDepth, AcceptsStripesOfNoiseAndHolesOverHalfThePicture) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> depth(0.1F, 30.0F);
  DepthMap wild;
  wild.depth_m = Raster<float>(120, 90, 2.0F);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x) {
      if (y % 10 < 3) wild.depth_m(x, y) = depth(random);
      if (x % 5 < 3) wild.depth_m(x, y) = std::numeric_limits<float>::quiet_NaN();
    }
  wild.depth_m(60, 45) = 1e6F;
  const auto relief = relief_from_depth(wild, {}, {});
  ASSERT_TRUE(relief);
  for (const float z : relief->samples_m().values()) ASSERT_TRUE(z >= 0.0F && z <= 0.0151F);
}

TEST(ReliefFromDepth, LimitsTheSlopeOfACliff) {
  DepthMap cliff;
  cliff.depth_m = Raster<float>(160, 120, 3.0F);
  for (int y = 0; y < 120; ++y)
    for (int x = 80; x < 160; ++x) cliff.depth_m(x, y) = 1.0F;
  const auto relief = relief_from_depth(cliff, {}, {});
  ASSERT_TRUE(relief);
  double steepest = 0.0;
  for (double x = -0.05; x < 0.05; x += 1e-5)
    steepest = std::max(steepest, std::abs(relief->sample(x, 0).dzdx));
  EXPECT_LE(steepest, 3.0);
  EXPECT_GE(steepest, 2.75);
}

TEST(ReliefFromDepth, SurvivesHolesSpikesAndASingleLevel) {
  DepthMap half = hill(120, 90);
  for (int y = 0; y < 90; ++y)
    for (int x = 0; x < 120; ++x)
      if ((x / 7 + y / 5) % 2 == 0) half.depth_m(x, y) = kUnknownDepth;
  half.depth_m(3, 3) = -4.0F;
  half.depth_m(5, 5) = 1e6F;
  half.depth_m(6, 6) = std::numeric_limits<float>::infinity();
  const auto relief = relief_from_depth(half, {}, {});
  ASSERT_TRUE(relief);
  EXPECT_GT(relief->sample(0, 0).z_m, 0.012);
  EXPECT_LT(relief->sample(0.045, 0.03).z_m, 0.003);

  DepthMap level;
  level.depth_m = Raster<float>(40, 40, 2.0F);
  const auto flat = relief_from_depth(level, {}, {});
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->highest_m(), 0.0);
}

TEST(ReliefFromDepth, RefusesMapsWithoutDepthAndOptionsOutOfRange) {
  DepthMap nothing;
  nothing.depth_m = Raster<float>(40, 40, kUnknownDepth);
  EXPECT_EQ(relief_from_depth(nothing, {}, {}).error().code, ErrorCode::invalid_input);
  nothing.depth_m = Raster<float>(1, 40, 1.0F);
  EXPECT_EQ(relief_from_depth(nothing, {}, {}).error().code, ErrorCode::invalid_input);
  ReliefOptions options;
  options.exaggerate = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(relief_from_depth(hill(40, 40), options, {}).error().code, ErrorCode::usage);
  options = {};
  options.near = options.far = 1.0;
  EXPECT_EQ(relief_from_depth(hill(40, 40), options, {}).error().code, ErrorCode::usage);
  options.near = 900.0;
  options.far = 1000.0;
  EXPECT_EQ(relief_from_depth(hill(40, 40), options, {}).error().code, ErrorCode::usage);
}

TEST(ReliefFromDepth, StopsWhenCancelled) {
  const std::atomic<bool> cancel{true};
  Work work;
  work.cancel = &cancel;
  EXPECT_EQ(relief_from_depth(hill(40, 40), {}, work).error().code, ErrorCode::interrupted);
}

TEST(ReliefFromDepth, ReducesLargePictures) {
  ReliefOptions options;
  options.most_pixels_on_a_side = 64;
  const auto relief = relief_from_depth(hill(200, 100), options, {});
  ASSERT_TRUE(relief);
  EXPECT_EQ(relief->samples_m().width(), 50);
  EXPECT_NEAR(relief->size_x_m(), 0.1, 1e-9);
}

TEST(ReliefFromDisparity, TakesDisparityAsNearnessWithoutACamera) {
  DisparityMap map;
  map.disparity_px = Raster<float>(60, 40, 4.0F);
  for (int y = 10; y < 30; ++y)
    for (int x = 20; x < 40; ++x) map.disparity_px(x, y) = 20.0F;
  map.disparity_px(1, 1) = kUnknownDepth;
  const auto relief = relief_from_disparity(map, {}, {});
  ASSERT_TRUE(relief);
  EXPECT_NEAR(relief->sample(0, 0).z_m, 0.015, 1e-6);
}

TEST(ReliefFromDisparity, UsesMetricDepthWithACamera) {
  DisparityMap map;
  map.disparity_px = Raster<float>(61, 40);
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 61; ++x) map.disparity_px(x, y) = 100.0F / (1.0F + 0.05F * static_cast<float>(x));
  StereoRig rig;
  rig.left = {500, 500, 30, 20, 61, 40};
  rig.baseline_m = 0.2;
  map.rig = rig;
  ReliefOptions options;
  options.detail = DetailOperator::linear;
  const auto relief = relief_from_disparity(map, options, {});
  ASSERT_TRUE(relief);
  // Depth increases linearly from left to right, so the relief is a plane. Disparity itself would not give a
  // plane.
  EXPECT_NEAR(relief->sample(0, 0).z_m, 0.5 * relief->highest_m(), 1e-5);
}

TEST(SceneFromPicture, PutsThePicturesCentreAtTheOriginAndTurnsItUp) {
  const auto relief = relief_from_depth(hill(200, 100), {}, {});
  ASSERT_TRUE(relief);
  const auto t = scene_from_picture(*relief, 200, 100);
  const auto centre = t * Point<models::InputFrame>{{99.5, 49.5, 0}};
  EXPECT_NEAR(norm(centre.v), 0.0, 1e-12);
  EXPECT_GT((t * Point<models::InputFrame>{{0, 0, 0}}).v.y, 0.0);
}

TEST(CloseHoles, FillsAPlaneAlmostExactlyAndKeepsKnownValues) {
  Raster<float> plane(64, 48);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) plane(x, y) = static_cast<float>(x) + 2.0F * static_cast<float>(y);
  Raster<float> holed = plane;
  for (int y = 20; y < 28; ++y)
    for (int x = 30; x < 38; ++x) holed(x, y) = kUnknownDepth;
  fill_unknown_heights(holed);
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool hole = x >= 30 && x < 38 && y >= 20 && y < 28;
      ASSERT_NEAR(holed(x, y), plane(x, y), hole ? 3.0F : 0.0F);
    }
}

}  // namespace
}  // namespace palpable::sculpt
