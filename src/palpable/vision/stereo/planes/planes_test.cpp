// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/planes.hpp"

#include "palpable/vision/stereo/planes/plain_picture.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kPlanesWidth = 90;
constexpr int kPlanesHeight = 40;

TEST(FittedPlanes, AreThePlaneOfTheDisparities) {
  const ColourPlanes colour = plain_picture(kPlanesWidth, kPlanesHeight);
  PlaneMap map(kPlanesWidth, kPlanesHeight);
  for (int y = 0; y < kPlanesHeight; ++y)
    for (int x = 0; x < kPlanesWidth; ++x)
      map.disparity(x, y) = 5.0F + 0.1F * static_cast<float>(x) - 0.05F * static_cast<float>(y);
  const Raster<float> all(kPlanesWidth, kPlanesHeight, 1.0F);
  PlaneMap fitted = map;
  for (int n = 0; n < 5; ++n) fitted = fit_planes(colour, fitted, all, {}, {}, {});
  for (int y = 6; y < kPlanesHeight - 6; ++y)
    for (int x = 6; x < kPlanesWidth - 6; ++x) {
      EXPECT_NEAR(fitted.slope_x(x, y), 0.1, 0.004);
      EXPECT_NEAR(fitted.slope_y(x, y), -0.05, 0.004);
      EXPECT_NEAR(fitted.disparity(x, y), map.disparity(x, y), 0.02);
    }
}

TEST(FittedPlanes, IgnorePixelsThatAreNotTrusted) {
  const ColourPlanes colour = plain_picture(kPlanesWidth, kPlanesHeight);
  PlaneMap map(kPlanesWidth, kPlanesHeight);
  Raster<float> trust(kPlanesWidth, kPlanesHeight, 1.0F);
  for (int y = 0; y < kPlanesHeight; ++y)
    for (int x = 0; x < kPlanesWidth; ++x) {
      map.disparity(x, y) = x < 45 ? 5.0F : 5.6F;
      if (x >= 45) trust(x, y) = 0.0F;
    }
  const PlaneMap fitted = fit_planes(colour, map, trust, {}, {}, {});
  EXPECT_NEAR(fitted.disparity(43, 20), 5.0, 1e-4);
  EXPECT_NEAR(fitted.slope_x(43, 20), 0.0, 1e-4);
}

TEST(Planes, OfOneViewBecomeThoseOfTheOther) {
  // In the left picture d = 6 + 0.1 x + 0.05 y; in the right one, from x - d = 0.9 x - 6 - 0.05 y, with
  // v = x - d: d = (6 + 0.1 v + 0.05 y) / 0.9. The right one is kept mirrored.
  PlaneMap left(kPlanesWidth, kPlanesHeight);
  for (int y = 0; y < kPlanesHeight; ++y)
    for (int x = 0; x < kPlanesWidth; ++x) {
      left.disparity(x, y) = 6.0F + 0.1F * static_cast<float>(x) + 0.05F * static_cast<float>(y);
      left.slope_x(x, y) = 0.1F;
      left.slope_y(x, y) = 0.05F;
    }
  const PlaneMap right = planes_in_other_view(left, {}, {});
  const PlaneMap again = planes_in_other_view(right, {}, {});
  int seen = 0;
  for (int y = 0; y < kPlanesHeight; ++y)
    for (int x = 0; x < kPlanesWidth; ++x) {
      const float d = right.disparity(x, y);
      if (std::isnan(d)) continue;
      ++seen;
      const auto v = static_cast<float>(kPlanesWidth - 1 - x);
      EXPECT_NEAR(d, (6.0F + 0.1F * v + 0.05F * static_cast<float>(y)) / 0.9F, 1e-4);
      EXPECT_NEAR(right.slope_x(x, y), -0.1 / 0.9, 1e-5);
      EXPECT_NEAR(right.slope_y(x, y), 0.05 / 0.9, 1e-5);
      if (std::isnan(again.disparity(x, y))) continue;
      EXPECT_NEAR(again.disparity(x, y), left.disparity(x, y), 1e-4);
    }
  EXPECT_GT(seen, kPlanesWidth * kPlanesHeight * 3 / 4);
}

TEST(Planes, InTheOtherViewAreTheNearestOfSeveral) {
  // A post at 10 px in front of a wall at 4 px occludes six of the wall's columns.
  PlaneMap left(kPlanesWidth, kPlanesHeight);
  left.disparity = Raster<float>(kPlanesWidth, kPlanesHeight, 4.0F);
  for (int y = 0; y < kPlanesHeight; ++y)
    for (int x = 40; x < 50; ++x) left.disparity(x, y) = 10.0F;
  const PlaneMap right = planes_in_other_view(left, {}, {});
  for (int x = 30; x < 40; ++x) EXPECT_EQ(right.disparity(kPlanesWidth - 1 - x, 20), 10.0F);
  EXPECT_EQ(right.disparity(kPlanesWidth - 1 - 29, 20), 4.0F);
  EXPECT_TRUE(std::isnan(right.disparity(kPlanesWidth - 1 - 45, 20)));
}

}  // namespace
}  // namespace palpable::vision
