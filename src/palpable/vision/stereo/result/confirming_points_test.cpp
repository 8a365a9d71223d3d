// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/result/confirming_points.hpp"

#include "palpable/vision/stereo/problem/centred_box.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// A match at (x, y) with this disparity.
FeatureMatch match_at(double x, double y, double disparity_px) { return {x, y, x - disparity_px, y}; }

TEST(ShareOffPlane, IsThatOfTheMatchesOffTheDominantPlane) {
  std::vector<FeatureMatch> matches;
  for (int k = 0; k < 80; ++k) {
    const double x = 10.0 * (k % 10), y = 10.0 * (k / 10);
    matches.push_back(match_at(x, y, 5.0 + 0.05 * x + 0.02 * y));
  }
  EXPECT_EQ(share_off_plane(matches, 1.5), 0.0);
  for (int k = 0; k < 20; ++k) matches.push_back(match_at(30.0 + k, 40.0 - k, 30.0));
  EXPECT_DOUBLE_EQ(share_off_plane(matches, 1.5), 0.2);
  EXPECT_EQ(share_off_plane({match_at(1, 2, 3)}, 1.5), 0.0);
}

TEST(ConfirmingPoints, ConfirmTheTrueDisparityOnly) {
  const SyntheticScene scene = centred_box_scene(320, 240);
  const StereoPair pair = render(scene);
  Raster<float> disparity_px(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) disparity_px(x, y) = static_cast<float>(scene.truth(x, y));
  const ConfirmingPoints found = confirming_points(pair, disparity_px);
  EXPECT_GT(found.count, 50);
  EXPECT_GT(found.on_rows, 0.9);
  EXPECT_GT(found.confirmed, 0.85);
  EXPECT_NEAR(found.range_px, scene.box_px - scene.ground_px, 0.5);
  EXPECT_GT(found.off_plane, 0.03);
  EXPECT_TRUE(found.rigid);
  EXPECT_GT(found.beyond_turn, 0.05);
  EXPECT_GT(found.depth_order, 0.95);

  for (float& d : disparity_px.values()) d += 20.0F;
  EXPECT_LT(confirming_points(pair, disparity_px).confirmed, 0.1);
  EXPECT_GT(confirming_points(pair, disparity_px, {.agree_px = 20.5}).confirmed, 0.85);
}

TEST(ConfirmingPoints, SeeThatADepthIsInsideOut) {
  const SyntheticScene scene = centred_box_scene(320, 240);
  Raster<float> disparity_px(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x)
      disparity_px(x, y) = static_cast<float>(scene.box_px + scene.ground_px - scene.truth(x, y));
  EXPECT_LT(confirming_points(render(scene), disparity_px).depth_order, -0.9);
}

}  // namespace
}  // namespace palpable::vision
