// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/planes/region_planes.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

constexpr int kRegionsWidth = 60;
constexpr int kRegionsHeight = 40;

/// A region over the whole picture that lies on a slope, but for its right third, which is at 20 px.
PlaneMap slope_and_board() {
  PlaneMap map(kRegionsWidth, kRegionsHeight);
  for (int y = 0; y < kRegionsHeight; ++y)
    for (int x = 0; x < kRegionsWidth; ++x) {
      const bool board = x >= 40;
      map.disparity(x, y) =
          board ? 20.0F : 3.0F + 0.1F * static_cast<float>(x) - 0.05F * static_cast<float>(y);
      map.slope_x(x, y) = board ? 0.0F : 0.1F;
      map.slope_y(x, y) = board ? 0.0F : -0.05F;
    }
  return map;
}

Regions one_region() {
  return {Raster<std::int32_t>(kRegionsWidth, kRegionsHeight, 0), {kRegionsWidth * kRegionsHeight}};
}

TEST(RegionPlanes, AreTheTwoWithMostInliers) {
  const RegionPlanes planes = planes_of_regions(one_region(), slope_and_board(),
                                                Raster<float>(kRegionsWidth, kRegionsHeight, 1.0F), {}, {});
  ASSERT_EQ(planes.size(), 1U);
  EXPECT_NEAR(planes[0][0].at(50, 10), 7.5F, 1e-4F);
  EXPECT_NEAR(planes[0][1].at(5, 10), 20.0F, 1e-4F);
}

TEST(RegionPlanes, CountOnlyTrustedPixels) {
  Raster<float> trust(kRegionsWidth, kRegionsHeight);
  for (int y = 0; y < kRegionsHeight; ++y)
    for (int x = 40; x < kRegionsWidth; ++x) trust(x, y) = 1.0F;
  const RegionPlanes planes = planes_of_regions(one_region(), slope_and_board(), trust, {}, {});
  EXPECT_NEAR(planes[0][0].at(5, 10), 20.0F, 1e-4F);
  EXPECT_NEAR(planes[0][1].at(5, 10), 20.0F, 1e-4F);
}

TEST(RegionPlanes, AreAPixelsPlaneIfNoneIsTrusted) {
  const RegionPlanes planes = planes_of_regions(one_region(), slope_and_board(),
                                                Raster<float>(kRegionsWidth, kRegionsHeight), {}, {});
  EXPECT_NEAR(planes[0][0].at(0, 0), 3.0F, 1e-4F);
}

}  // namespace
}  // namespace palpable::vision
