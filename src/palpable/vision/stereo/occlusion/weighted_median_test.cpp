// Copyright 2026 The Palpable authors
// SPDX-License-Identifier: Apache-2.0
#include "palpable/vision/stereo/occlusion/weighted_median.hpp"

#include <gtest/gtest.h>

namespace palpable::vision {
namespace {

/// Two halves of different colour; disparity 4 on the left, 9 on the right, but for one wrong pixel on each
/// side.
struct Halves {
  ColourPlanes colour;
  Raster<int> disparity{30, 20, 4};
  Raster<float> trust{30, 20, 1.0F};

  Halves() {
    Raster<std::uint8_t> plane(30, 20, 60);
    for (int y = 0; y < 20; ++y)
      for (int x = 15; x < 30; ++x) {
        plane(x, y) = 180;
        disparity(x, y) = 9;
      }
    colour = {plane, plane, plane};
    disparity(14, 10) = 9;
    disparity(16, 10) = 4;
  }
};

TEST(WeightedMedian, FollowsTheColour) {
  const Halves scene;
  const Raster<int> out = weighted_median(scene.colour, scene.disparity, scene.trust, 12, {}, {});
  for (int y = 0; y < 20; ++y)
    for (int x = 0; x < 30; ++x) EXPECT_EQ(out(x, y), x < 15 ? 4 : 9) << x << ' ' << y;
}

TEST(WeightedMedian, CountsOnlyTrustedPixels) {
  Halves scene;
  scene.trust = Raster<float>(30, 20);
  scene.trust(8, 8) = 1.0F;
  scene.disparity(8, 8) = 7;
  const Raster<int> out = weighted_median(scene.colour, scene.disparity, scene.trust, 12, {.step_px = 1}, {});
  EXPECT_EQ(out(4, 4), 7);
}

TEST(WeightedMedian, KeepsAPixelWithoutTrustedNeighbours) {
  Halves scene;
  scene.trust = Raster<float>(30, 20);
  EXPECT_EQ(weighted_median(scene.colour, scene.disparity, scene.trust, 12, {}, {}), scene.disparity);
}

}  // namespace
}  // namespace palpable::vision
