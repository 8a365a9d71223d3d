// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/sculpt/relief/relief_in_window.hpp"

#include "palpable/core/picture/camera.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace palpable::sculpt {
namespace {

constexpr vision::DepthRange kWindow{1.0, 2.0};

Raster<float> plane_at(float z_m) { return Raster<float>(20, 10, z_m); }

TEST(ReliefInWindow, MapsDepthLinearlyWhateverElseIsSeen) {
  auto depth_m = plane_at(1.5F);
  const auto alone = relief_in_window(depth_m, kWindow, {});
  ASSERT_TRUE(alone) << alone.error().sentence();
  EXPECT_NEAR(alone->samples_m()(2, 5), 0.0075F, 1e-6F);
  EXPECT_DOUBLE_EQ(alone->pixel_m(), 0.005);
  depth_m(19, 9) = 0.3F;
  EXPECT_EQ(relief_in_window(depth_m, kWindow, {})->samples_m()(2, 5), alone->samples_m()(2, 5));
}

TEST(ReliefInWindow, PutsUnknownAndFarPixelsAtTheBaseAndNearOnesAtTheTop) {
  EXPECT_EQ(relief_in_window(plane_at(kUnknownDepth), kWindow, {})->samples_m()(3, 3), 0.0F);
  EXPECT_EQ(relief_in_window(plane_at(5.0F), kWindow, {})->samples_m()(3, 3), 0.0F);
  EXPECT_FLOAT_EQ(relief_in_window(plane_at(0.2F), kWindow, {})->samples_m()(3, 3), 0.015F);
}

TEST(ReliefInWindow, KeepsTheSteepestSlope) {
  auto depth_m = plane_at(2.0F);
  for (int y = 0; y < 10; ++y)
    for (int x = 10; x < 20; ++x) depth_m(x, y) = 1.0F;
  WindowedReliefOptions options;
  options.steepest_slope = 1.0;
  const auto relief = relief_in_window(depth_m, kWindow, options);
  float steepest = 0.0F;
  for (int x = 1; x < 20; ++x)
    steepest = std::max(steepest, std::abs(relief->samples_m()(x, 5) - relief->samples_m()(x - 1, 5)));
  EXPECT_LE(steepest, 1.0F * 0.005F + 1e-6F);
  EXPECT_GT(steepest, 0.5F * 0.005F);
}

TEST(ReliefInWindow, RefusesWhatHasNoMeaning) {
  EXPECT_EQ(relief_in_window(plane_at(1.0F), {2.0, 1.0}, {}).error().code, ErrorCode::usage);
  EXPECT_EQ(relief_in_window(plane_at(1.0F), {std::nan(""), 1.0}, {}).error().code, ErrorCode::usage);
  EXPECT_EQ(relief_in_window(Raster<float>(1, 5, 1.0F), kWindow, {}).error().code, ErrorCode::invalid_input);
  WindowedReliefOptions options;
  options.steepest_slope = 0.0;
  EXPECT_EQ(relief_in_window(plane_at(1.0F), kWindow, options).error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace palpable::sculpt
