// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/result/front_view.hpp"

#include "palpable/vision/stereo/problem/synthetic_pair.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

TEST(FrontView, ShiftsEachSurfaceByHalfItsDisparity) {
  const SyntheticScene scene;  // ground 6, box 14 pixels
  const StereoPair pair = render(scene);
  Raster<float> truth(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) truth(x, y) = static_cast<float>(scene.truth(x, y));
  const auto view = front_view(pair, truth, {});
  ASSERT_TRUE(view);
  // In the middle view the box begins 7 pixels farther left than in the left picture.
  for (int x = scene.box_left - 7; x < scene.box_right - 7; ++x) {
    EXPECT_FLOAT_EQ(view->disparity_px(x, 50), 14.0F);
    EXPECT_NEAR(static_cast<double>(view->picture.pixel(x, 50)[0]), texture(x + 7, 50, 1), 1e-4);
  }
  // Ground beside the box: at its left only the left camera sees it, at its right only the right one.
  for (const int x : {scene.box_left - 9, scene.box_right - 5, 20, 140})
    EXPECT_NEAR(static_cast<double>(view->picture.pixel(x, 50)[0]), texture(x + 3, 50, 0), 0.02) << x;
}

TEST(FrontView, RefusesADisparityMapOfAnotherSize) {
  EXPECT_FALSE(front_view(render({}), Raster<float>(3, 3), {}));
}

}  // namespace
}  // namespace palpable::vision
