// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/core/picture/camera.hpp"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace palpable {
namespace {

constexpr float kUnknown = std::numeric_limits<float>::quiet_NaN();
const StereoRig kRig{{800.0, 800.0, 1.0, 0.5, 3, 2}, 0.12, 4.0};

DisparityMap three_by_two(std::optional<StereoRig> rig) {
  DisparityMap map{Raster<float>(3, 2), rig};
  map.disparity_px(0, 0) = 60.0F;
  map.disparity_px(1, 0) = 0.0F;
  map.disparity_px(2, 0) = kUnknown;
  map.disparity_px(0, 1) = -4.0F;
  map.disparity_px(1, 1) = -5.0F;
  map.disparity_px(2, 1) = 28.0F;
  return map;
}

TEST(DepthFromDisparity, IsBaselineTimesFocalLengthOverShiftedDisparity) {
  const auto depth = depth_from_disparity(three_by_two(kRig));
  ASSERT_TRUE(depth);
  EXPECT_FLOAT_EQ(depth->depth_m(0, 0), 0.12F * 800.0F / 64.0F);
  EXPECT_FLOAT_EQ(depth->depth_m(1, 0), 0.12F * 800.0F / 4.0F);
  EXPECT_FLOAT_EQ(depth->depth_m(2, 1), 0.12F * 800.0F / 32.0F);
  EXPECT_EQ(depth->camera, kRig.left);
}

TEST(DepthFromDisparity, LeavesWhatHasNoPositiveDepthUnknown) {
  const auto depth = depth_from_disparity(three_by_two(kRig));
  ASSERT_TRUE(depth);
  EXPECT_TRUE(std::isnan(depth->depth_m(2, 0)));  // unknown disparity
  EXPECT_TRUE(std::isnan(depth->depth_m(0, 1)));  // at infinity
  EXPECT_TRUE(std::isnan(depth->depth_m(1, 1)));  // behind the camera
}

TEST(DepthFromDisparity, NeedsTheRig) { EXPECT_FALSE(depth_from_disparity(three_by_two(std::nullopt))); }

}  // namespace
}  // namespace palpable
