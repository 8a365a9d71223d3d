// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sources/depth/colour_registration.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable::sources {
namespace {

/// A smooth picture whose red gives the column and whose green gives the row.
Image coordinates(int width, int height) {
  Image image{width, height, 3, 8, {}};
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      image.samples.insert(image.samples.end(),
                           {static_cast<float>(x) / 1000.0F, static_cast<float>(y) / 1000.0F, 0.25F});
  return image;
}

DepthMap plane(double z) {
  return {Raster<float>(64, 48, static_cast<float>(z)), Pinhole{60.0, 60.0, 31.5, 23.5, 64, 48}};
}

TEST(ColourAtDepth, FollowsTheTwoPinholesAndTheirTransform) {
  ColourCamera colour;
  colour.camera = {130.0, 128.0, 70.0, 52.0, 160, 120};
  // Rotated by the Pythagorean angle asin(7/25) about y, and translated.
  colour.rotation = {0.96, 0, 0.28, 0, 1, 0, -0.28, 0, 0.96};
  colour.translation_m = {-0.30, 0.01, 0.05};
  const DepthMap depth = plane(1.2);
  const auto seen = colour_at_depth(depth, coordinates(160, 120), colour);
  ASSERT_TRUE(seen) << seen.error().message;
  int inside = 0;
  for (int y = 0; y < 48; ++y)
    for (int x = 0; x < 64; ++x) {
      const double px = (x - 31.5) / 60.0 * 1.2;
      const double py = (y - 23.5) / 60.0 * 1.2;
      const double qx = 0.96 * px + 0.28 * 1.2 - 0.30;
      const double qy = py + 0.01;
      const double qz = -0.28 * px + 0.96 * 1.2 + 0.05;
      const double u = 130.0 * qx / qz + 70.0;
      const double v = 128.0 * qy / qz + 52.0;
      const bool within = u >= 0 && v >= 0 && u <= 159 && v <= 119;
      if (!within) continue;
      ++inside;
      ASSERT_EQ(seen->pixel(x, y)[3], 1.0F) << x << " " << y;
      EXPECT_NEAR(seen->pixel(x, y)[0], u / 1000.0, 1e-5);
      EXPECT_NEAR(seen->pixel(x, y)[1], v / 1000.0, 1e-5);
    }
  EXPECT_GT(inside, 1000);
}

TEST(ColourAtDepth, LeavesOutWhatIsHiddenUnknownOrOutside) {
  DepthMap depth = plane(2.0);
  // A post in front of a wall. The colour camera is to the right, so for it the post hides a part of the wall
  // to the left of the post.
  for (int y = 0; y < 48; ++y)
    for (int x = 28; x < 36; ++x) depth.depth_m(x, y) = 1.0F;
  depth.depth_m(5, 5) = std::numeric_limits<float>::quiet_NaN();
  ColourCamera colour;
  colour.camera = *depth.camera;
  colour.translation_m = {-0.2, 0, 0};
  const auto seen = colour_at_depth(depth, coordinates(64, 48), colour);
  ASSERT_TRUE(seen);
  const auto alpha = [&](int x, int y) { return seen->pixel(x, y)[3]; };
  // The post moves 12 columns to the left in the colour picture, the wall 6: columns 22 … 29 of the wall lie
  // behind it.
  EXPECT_EQ(alpha(32, 20), 1.0F);
  EXPECT_EQ(alpha(24, 20), 0.0F);
  EXPECT_EQ(alpha(27, 20), 0.0F);
  EXPECT_EQ(alpha(12, 20), 1.0F);
  EXPECT_EQ(alpha(45, 20), 1.0F);
  EXPECT_EQ(alpha(5, 5), 0.0F) << "unknown depth";
  EXPECT_EQ(alpha(2, 20), 0.0F) << "outside the colour picture";
}

TEST(ColourAtDepth, NeedsCamerasOfTheRightSize) {
  ColourCamera colour;
  colour.camera = {60, 60, 31.5, 23.5, 64, 48};
  DepthMap depth = plane(1.0);
  EXPECT_TRUE(colour_at_depth(depth, coordinates(64, 48), colour));
  EXPECT_FALSE(colour_at_depth(depth, coordinates(65, 48), colour));
  depth.camera.reset();
  EXPECT_FALSE(colour_at_depth(depth, coordinates(64, 48), colour));
}

}  // namespace
}  // namespace palpable::sources
